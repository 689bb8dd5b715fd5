#pragma once

#include "base/geometry.h"
#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <optional>

namespace mfar {

/// When the surface that catches shadows is measured again.
struct CatcherRule {
    int settling = 12;         ///< frames before the measured depth replaces the plane
    double leastKnown = 0.7;   ///< lower limit of the known share of the region around the objects
    double turn = 0.35;        ///< rotation around the objects until the next measurement [rad]
    double leastInterval = 4;  ///< lower limit of the time between two measurements [s]
};

/// Keeps the scene's shadow catcher up to date with the real scene: shadows of virtual objects
/// first fall onto the plane of the tag map, later onto the measured surface.
class SceneFollower {
public:
    explicit SceneFollower(const CatcherRule& rule = {}) : rule_(rule) {}

    /// Sets other objects or light; the catcher is replaced. Returns the scene to show.
    std::shared_ptr<const Scene> set(Scene scene);

    /// The same scene in another light.
    std::shared_ptr<const Scene> relight(Lighting lighting);

    /// Call after a frame with the depths measured in `region` [video px] around the objects.
    /// Returns the scene if it has changed, otherwise null.
    std::shared_ptr<const Scene> follow(const InverseDepthField& field, const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const PixelRect& region, Timestamp time);

private:
    [[nodiscard]] bool isDue(const RigidTransform& T_world_video, Timestamp time) const;

    CatcherRule rule_;
    Scene scene_;
    Eigen::AlignedBox3d objects_;
    int frames_ = 0;
    std::optional<Timestamp> caught_;  // time of the catcher's measurement
    Eigen::Vector3d caughtFrom_{0, 0, 0};
};

}  // namespace mfar
