#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/scene/scene.h"

#include <vector>

namespace mfar {

/// Boxes around the parts of a scene's surfaces. They bound where virtual surfaces are in a
/// picture, at a cost independent of the number of triangles.
class SceneBoxes {
public:
    /// No boxes.
    SceneBoxes() = default;
    /// Boxes around the scene's objects.
    explicit SceneBoxes(const Scene& scene);
    /// Boxes around the surface that shows their shadows.
    explicit SceneBoxes(const ShadowCatcher& catcher);

    /// Extent of each box that is at least partly beyond the near plane. Valid until the next call.
    const std::vector<SurfaceExtent>& extents(const LensProjection& lens,
                                              const RigidTransform& T_world_video);

    [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& world() const { return boxes_; }

private:
    std::vector<Eigen::AlignedBox3d> boxes_;  // [m], along the world's axes
    std::vector<SurfaceExtent> extents_;
};

}  // namespace mfar
