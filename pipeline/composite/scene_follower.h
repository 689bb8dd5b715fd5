#pragma once

#include "base/geometry.h"
#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <memory>
#include <optional>

namespace mfar {

/// Decides when the surface that catches shadows (the shadow catcher) is measured again.
struct CatcherRule {
    int settling = 12;         ///< number of frames before the measured surface replaces the plane
    double leastKnown = 0.7;   ///< least share of known depth around the objects
    double turn = 0.35;        ///< camera turn around the objects that causes a measurement [rad]
    double leastInterval = 4;  ///< least time between two measurements [s]
};

/// Keeps the scene's shadow catcher up to date with the real scene. At first, shadows of virtual
/// objects fall onto the plane of the tag map; later, they fall onto the measured surface.
class SceneFollower {
public:
    explicit SceneFollower(const CatcherRule& rule = {}) : rule_(rule) {}

    /// Replaces the scene. Its shadow catcher becomes the plane of the tag map again. Returns the
    /// scene to show.
    std::shared_ptr<const Scene> set(Scene scene);

    /// Changes the light. Returns the scene to show.
    std::shared_ptr<const Scene> relight(Lighting lighting);

    /// Call this after each frame. `field` holds the depths that were measured in `region` [video
    /// px] around the objects. Returns the scene to show if the shadow catcher has changed,
    /// otherwise null.
    std::shared_ptr<const Scene> follow(const InverseDepthField& field, const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const PixelRect& region, Timestamp time);

private:
    [[nodiscard]] bool isDue(const RigidTransform& T_world_video, Timestamp time) const;

    CatcherRule rule_;
    Scene scene_;
    Eigen::AlignedBox3d objects_;
    int frames_ = 0;
    std::optional<Timestamp> caught_;  // when the shadow catcher was measured
    Eigen::Vector3d caughtFrom_{0, 0, 0};
};

}  // namespace mfar
