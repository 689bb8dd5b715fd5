#pragma once

#include "base/gl/pass.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/scene/scene.h"
#include "pipeline/warp/pass_params.h"
#include "pipeline/warp/surface_mesh.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// What of the virtual scene a camera sees now: the models and, below them, the real surface that
/// catches their shadows, rasterised at twice the layer's resolution, so that a pixel is covered by
/// quarters. The lens's distortion acts on the vertices. No light, no colours.
class ModelSilhouette {
public:
    /// `layer`: the camera at the layer's resolution. Throws GlError without R32UI targets.
    explicit ModelSilhouette(const CameraModel& layer);

    /// Uploads the meshes; of a scene of more than 20000 triangles simplified ones. Surfaces whose
    /// alpha is masked have their holes.
    void setScene(const Scene& scene);

    /// Layer pixels around all objects; of one that reaches before the near plane and beyond it,
    /// all of them.
    [[nodiscard]] PixelRect bounds(const RigidTransform& T_world_camera) const;

    /// Draws within `where` [layer px]; elsewhere there is nothing afterwards.
    void draw(const RigidTransform& T_world_camera, const PixelRect& where);

    /// The catcher, if it is one plane and therefore not drawn: n . point = w in the world [m].
    /// Otherwise zero.
    [[nodiscard]] const Eigen::Vector4d& plane() const { return plane_; }
    /// R32UI, twice the layer's size: z and number, packed as warp_surface.glsl says; 0 = nothing.
    /// The catcher's number is seen only where no object is, nearer or not.
    [[nodiscard]] const gpu::Texture& surface() const { return surface_; }
    [[nodiscard]] std::size_t triangles() const { return triangles_; }

private:
    struct Part {
        gpu::Buffer vertices, indices;
        int indexCount;
        std::optional<gpu::Texture> alpha;  // of masked surfaces
        float cutoff;
        bool bothSides = true;  // are seen
    };
    struct Shape {
        std::vector<Part> parts;
        Eigen::AlignedBox3d box;
        std::shared_ptr<const Model> model;  // none: the catcher
    };
    struct Object {
        std::size_t shape;
        RigidTransform T_world_object;
        double scale;
    };

    static Part partOf(const SurfaceMesh& mesh);
    void clear(const PixelRect& where) const;
    [[nodiscard]] Shape shapeOf(const std::shared_ptr<const Model>& model) const;
    void addCatcher(const ShadowCatcher& catcher);
    void drawObject(const Object& object, std::size_t number, const RigidTransform& T_camera_world);
    [[nodiscard]] PixelRect boundsOf(const Object& object,
                                     const RigidTransform& T_camera_world) const;

    LensProjection lens_;
    std::deque<Shape> shapes_;
    std::vector<Object> objects_;
    std::optional<Object> catcher_;
    Eigen::Vector4d plane_ = Eigen::Vector4d::Zero();
    std::size_t triangles_ = 0;
    double share_ = 1;  // of the models' triangles that are drawn
    PixelRect drawn_;
    gpu::Texture surface_, window_;
    gpu::Framebuffer target_;
    gpu::DrawPass<params::SilhouetteMesh> pass_, maskedPass_;
};

}  // namespace mfar
