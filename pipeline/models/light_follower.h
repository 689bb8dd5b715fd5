#pragma once

#include "pipeline/models/light_estimate.h"

#include <optional>

namespace mfar {

/// Updates a scene's light from the camera's pictures, twice a second.
class LightFollower {
public:
    /// `sun`: if set, it is always used instead of an estimated one.
    explicit LightFollower(const std::optional<Sun>& sun) : sun_(sun) {}

    /// Adds a frame as LightEstimator::add() does. Returns the light if it has changed.
    std::optional<Lighting> follow(const ImageView& frame, const CameraModel& camera,
                                   const RigidTransform& T_world_camera, Timestamp time);

private:
    LightEstimator estimator_;
    std::optional<Sun> sun_;
    std::optional<Timestamp> seen_;
};

}  // namespace mfar
