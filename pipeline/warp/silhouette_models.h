#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/scene/scene.h"
#include "pipeline/warp/surface_mesh.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

/// A scene's models and shadow catcher, prepared for drawing silhouettes through a lens. It holds
/// triangles, materials and textures, but no light.
class SilhouetteModels {
public:
    explicit SilhouetteModels(const CameraModel& layer);

    /// Simplifies the models of scenes with more than 20000 triangles.
    void setScene(const Scene& scene);

    struct Part {
        SurfaceMesh mesh;
        const SurfaceTexture* alpha = nullptr;  ///< a repeating alpha mask; null: no mask
        float cutoff = 0;                       ///< texels with a smaller alpha are transparent
        bool bothSides = true;
        const Material* material = nullptr;
        /// Null if the mesh has no uvs or the material has no such texture.
        const SurfaceTexture *baseColour = nullptr, *metallicRoughness = nullptr;
    };
    struct Shape {
        std::vector<Part> parts;
        Eigen::AlignedBox3d box;
        std::shared_ptr<const Model> model;  ///< owns the materials; null for the shadow catcher
        int part = 0;                        ///< see Mesh::part
    };
    struct Object {
        std::shared_ptr<const Shape> shape;
        RigidTransform T_world_object;
        double scale;
    };
    [[nodiscard]] const std::vector<Object>& objects() const { return objects_; }
    /// Moves the objects. `T_world_objects` has one pose for each object.
    void setPoses(std::span<const RigidTransform> T_world_objects);
    /// The shadow catcher as an object to draw. Empty if there is no catcher or it is planar.
    [[nodiscard]] const std::optional<Object>& catcher() const { return catcher_; }
    /// Plane (n, w) of a planar shadow catcher: n . point = w in the world frame [m]. Zero if the
    /// catcher is not planar. A planar catcher is not drawn.
    [[nodiscard]] const Eigen::Vector4d& plane() const { return plane_; }
    [[nodiscard]] std::size_t triangles() const { return triangles_; }
    [[nodiscard]] const LensProjection& lens() const { return lens_; }

    /// Bounds of all objects [layer px]. They are the whole layer if an object crosses the near
    /// plane.
    [[nodiscard]] PixelRect bounds(const RigidTransform& T_world_camera) const;
    /// Bounds of one object [layer px]. They are the whole layer if the object crosses the near
    /// plane.
    [[nodiscard]] PixelRect boundsOf(const Object& object,
                                     const RigidTransform& T_camera_world) const;

private:
    [[nodiscard]] std::shared_ptr<const Shape> shapeOf(const SceneObject& object) const;
    void setCatcher(const ShadowCatcher& catcher);

    LensProjection lens_;
    std::vector<Object> objects_;
    std::optional<Object> catcher_;
    Eigen::Vector4d plane_ = Eigen::Vector4d::Zero();
    std::size_t triangles_ = 0;
    double share_ = 1;
};

}  // namespace mfar
