#pragma once

#include "base/geometry.h"
#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <optional>

namespace mfar {

/// When the surface that catches shadows is made anew.
struct CatcherRule {
    int settling = 12;         ///< frames before measured depth takes the plane's place
    double leastKnown = 0.7;   ///< share of the region around the objects
    double turn = 0.35;        ///< angle about the objects from which they are seen anew [rad]
    double leastInterval = 4;  ///< from one to the next [s]
};

/// Keeps a scene of virtual objects as the real one around it is found to be: their shadows fall
/// onto the plane of the tag map at first, then onto the measured surface.
class SceneFollower {
public:
    explicit SceneFollower(const CatcherRule& rule = {}) : rule_(rule) {}

    /// Other objects or light; its catcher is replaced. Returns what is to be shown.
    std::shared_ptr<const Scene> set(Scene scene);

    /// The same scene in another light.
    std::shared_ptr<const Scene> relight(Lighting lighting);

    /// After a frame: what was measured in `region` [video px] around the objects. Returns the
    /// scene when it has changed, null otherwise.
    std::shared_ptr<const Scene> follow(const InverseDepthField& field, const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const PixelRect& region, Timestamp time);

private:
    [[nodiscard]] bool isDue(const RigidTransform& T_world_video, Timestamp time) const;

    CatcherRule rule_;
    Scene scene_;
    Eigen::AlignedBox3d objects_;
    int frames_ = 0;
    std::optional<Timestamp> caught_;  // when the catcher was measured
    Eigen::Vector3d caughtFrom_{0, 0, 0};
};

}  // namespace mfar
