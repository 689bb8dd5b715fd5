#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/scene/scene.h"

#include <vector>

namespace mfar {

/// Boxes around the parts of a scene's surfaces: where something virtual may be in a picture, at a
/// cost that does not depend on how many triangles there are.
class SceneBoxes {
public:
    /// None: no box.
    SceneBoxes() = default;
    /// Of its objects.
    explicit SceneBoxes(const Scene& scene);
    /// Of the surface on which their shadows are seen.
    explicit SceneBoxes(const ShadowCatcher& catcher);

    /// What each box that reaches before the near plane covers. Valid until the next call.
    const std::vector<SurfaceExtent>& extents(const LensProjection& lens,
                                              const RigidTransform& T_world_video);

    [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& world() const { return boxes_; }

private:
    std::vector<Eigen::AlignedBox3d> boxes_;  // [m], along the world's axes
    std::vector<SurfaceExtent> extents_;
};

}  // namespace mfar
