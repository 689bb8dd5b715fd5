#include "pipeline/models/light_follower.h"

namespace mfar {
namespace {

constexpr double kInterval = 0.5;

}  // namespace

std::optional<Lighting> LightFollower::follow(const ImageView& frame, const CameraModel& camera,
                                              const RigidTransform& T_world_camera,
                                              Timestamp time) {
    if (seen_ && !((time - *seen_).count() > kInterval * 1e9)) return std::nullopt;
    seen_ = time;
    // If the frame was ignored, the light is unchanged. Returning it would relight the scene for
    // nothing.
    if (!estimator_.add(frame, camera, T_world_camera, time)) return std::nullopt;
    const std::optional<LightEstimate> estimate = estimator_.estimate();
    if (!estimate) return std::nullopt;
    Lighting lighting = lightingOf(*estimate);
    if (sun_) lighting.sun = sun_;
    return lighting;
}

}  // namespace mfar
