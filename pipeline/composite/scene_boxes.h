#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/scene/scene.h"

#include <vector>

namespace mfar {

/// Boxes around the parts of a scene's surfaces, which show where a picture can contain virtual
/// surfaces. The time for projecting them does not depend on the number of triangles.
class SceneBoxes {
public:
    SceneBoxes() = default;
    explicit SceneBoxes(const Scene& scene);
    explicit SceneBoxes(const ShadowCatcher& catcher);

    /// Returns the extent of each box that lies at least partly beyond the near plane. The result
    /// is valid until the next call.
    const std::vector<SurfaceExtent>& extents(const LensProjection& lens,
                                              const RigidTransform& T_world_video);

    [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& world() const { return boxes_; }

private:
    std::vector<Eigen::AlignedBox3d> boxes_;
    std::vector<SurfaceExtent> extents_;
};

}  // namespace mfar
