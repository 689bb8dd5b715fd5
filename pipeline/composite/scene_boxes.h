#pragma once

#include "pipeline/composite/object_projection.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <vector>

namespace mfar {

/// Boxes around the parts of a scene's surfaces. Their projections cover all places where a picture
/// can contain virtual surfaces. The time for projecting them does not depend on the number of
/// triangles.
class SceneBoxes {
public:
    SceneBoxes() = default;
    explicit SceneBoxes(const Scene& scene);
    explicit SceneBoxes(const ShadowCatcher& catcher);

    /// Moves the boxes of moving objects to their poses at this time.
    void setTime(Timestamp time);
    [[nodiscard]] bool empty() const { return boxes_.empty() && moving_.empty(); }

    /// Returns the extent of each box that lies at least partly beyond the near plane. The result
    /// is valid until the next call.
    const std::vector<SurfaceExtent>& extents(const LensProjection& lens,
                                              const RigidTransform& T_world_video);

    /// The boxes of objects that do not move, in world coordinates.
    [[nodiscard]] const std::vector<Eigen::AlignedBox3d>& world() const { return boxes_; }

private:
    struct Moving {
        std::shared_ptr<const RigidPath> path;
        RigidTransform T_world_object;
        std::vector<Eigen::AlignedBox3d> boxes;  // in the object's frame
    };
    void addExtents(const std::vector<Eigen::AlignedBox3d>& boxes, const LensProjection& lens,
                    const RigidTransform& T_video_boxes);

    std::vector<Eigen::AlignedBox3d> boxes_;
    std::vector<Moving> moving_;
    std::vector<SurfaceExtent> extents_;
};

}  // namespace mfar
