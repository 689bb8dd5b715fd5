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

/// The models of a scene and the shadow catcher, prepared for drawing silhouettes through a lens.
/// It holds triangles, materials and textures, but no light.
class SilhouetteModels {
public:
    /// `layer` is the camera, scaled to the layer's resolution.
    explicit SilhouetteModels(const CameraModel& layer);

    /// Simplifies the models if the scene has more than 20000 triangles.
    void setScene(const Scene& scene);

    struct Part {
        SurfaceMesh mesh;
        const SurfaceTexture* alpha = nullptr;  ///< alpha mask, which repeats; null: no mask
        float cutoff = 0;                       ///< texels with a smaller alpha are holes
        bool bothSides = true;                  ///< whether the back side is visible
        const Material* material = nullptr;     ///< null for the shadow catcher
        /// Textures of the material; null if the mesh has no uvs.
        const SurfaceTexture *baseColour = nullptr, *metallicRoughness = nullptr;
    };
    struct Shape {
        std::vector<Part> parts;
        Eigen::AlignedBox3d box;
        std::shared_ptr<const Model> model;  ///< owns the materials; null: the shadow catcher
    };
    struct Object {
        std::shared_ptr<const Shape> shape;  ///< objects with the same model have the same shape
        RigidTransform T_world_object;
        double scale;
    };
    [[nodiscard]] const std::vector<Object>& objects() const { return objects_; }
    /// The shadow catcher as an object to draw. Empty if there is no shadow catcher or it is
    /// planar.
    [[nodiscard]] const std::optional<Object>& catcher() const { return catcher_; }
    /// Plane (n, w) of a planar shadow catcher, which is not drawn: n . point = w in the world [m].
    /// Zero if the shadow catcher is not planar.
    [[nodiscard]] const Eigen::Vector4d& plane() const { return plane_; }
    [[nodiscard]] std::size_t triangles() const { return triangles_; }
    [[nodiscard]] const LensProjection& lens() const { return lens_; }

    /// Bounds of all objects [layer px]. If an object crosses the near plane, the bounds are the
    /// whole layer.
    [[nodiscard]] PixelRect bounds(const RigidTransform& T_world_camera) const;
    /// Bounds of one object [layer px]. If the object crosses the near plane, the bounds are the
    /// whole layer.
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
    double share_ = 1;  // share of the models' triangles that is kept when they are simplified
};

}  // namespace mfar
