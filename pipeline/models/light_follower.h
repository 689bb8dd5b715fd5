#pragma once

#include "pipeline/models/light_estimate.h"

#include <optional>

namespace mfar {

/// Keeps a scene's light as the camera's pictures show it, twice a second.
class LightFollower {
public:
    /// `sun`: stays, whatever the pictures say.
    explicit LightFollower(const std::optional<Sun>& sun) : sun_(sun) {}

    /// Takes a frame as LightEstimator::add() does. Returns the light when it has changed.
    std::optional<Lighting> follow(const ImageView& frame, const CameraModel& camera,
                                   const RigidTransform& T_world_camera, Timestamp time);

private:
    LightEstimator estimator_;
    std::optional<Sun> sun_;
    std::optional<Timestamp> seen_;
};

}  // namespace mfar
