#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/scene/scene.h"
#include "pipeline/warp/surface_mesh.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// The models of a scene and, below them, the real surface that catches their shadows, as the
/// silhouette draws them through a lens: triangles and what they are painted with, no light.
class SilhouetteModels {
public:
    /// `layer`: the camera at the layer's resolution.
    explicit SilhouetteModels(const CameraModel& layer);

    /// Simplifies the models if the scene has more than 20000 triangles.
    void setScene(const Scene& scene);

    struct Part {
        SurfaceMesh mesh;
        const SurfaceTexture* alpha = nullptr;  ///< of a masked surface; repeats
        float cutoff = 0;                       ///< a texel's alpha below it is a hole
        bool bothSides = true;                  ///< are seen
        const Material* material = nullptr;     ///< none: the catcher
        /// Of the material; none where the mesh has no uvs.
        const SurfaceTexture *baseColour = nullptr, *metallicRoughness = nullptr;
    };
    struct Shape {
        std::vector<Part> parts;
        Eigen::AlignedBox3d box;
        std::shared_ptr<const Model> model;  ///< owns materials and textures; none: the catcher
    };
    struct Object {
        std::shared_ptr<const Shape> shape;  ///< shared by scenes with the same model
        RigidTransform T_world_object;
        double scale;
    };
    [[nodiscard]] const std::vector<Object>& objects() const { return objects_; }
    /// The catcher, if it has to be drawn.
    [[nodiscard]] const std::optional<Object>& catcher() const { return catcher_; }
    /// The catcher, if it is planar and therefore not drawn: n . point = w in the world [m].
    /// Otherwise zero.
    [[nodiscard]] const Eigen::Vector4d& plane() const { return plane_; }
    [[nodiscard]] std::size_t triangles() const { return triangles_; }
    [[nodiscard]] const LensProjection& lens() const { return lens_; }

    /// Bounds of all objects [layer px]; the whole layer for an object that crosses the near plane.
    [[nodiscard]] PixelRect bounds(const RigidTransform& T_world_camera) const;
    /// As above, for one object.
    [[nodiscard]] PixelRect boundsOf(const Object& object,
                                     const RigidTransform& T_camera_world) const;

private:
    [[nodiscard]] std::shared_ptr<const Shape>
    shapeOf(const std::shared_ptr<const Model>& model) const;
    void setCatcher(const ShadowCatcher& catcher);

    LensProjection lens_;
    std::vector<Object> objects_;
    std::optional<Object> catcher_;
    Eigen::Vector4d plane_ = Eigen::Vector4d::Zero();
    std::size_t triangles_ = 0;
    double share_ = 1;  // share of the models' triangles that are drawn
};

}  // namespace mfar
