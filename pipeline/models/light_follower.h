#pragma once

#include "pipeline/models/light_estimate.h"

#include <optional>

namespace mfar {

class LightFollower {
public:
    /// If `sun` is set, it replaces the estimated sun.
    explicit LightFollower(const std::optional<Sun>& sun) : sun_(sun) {}

    /// Must be called for each frame. Passes at most two frames a second to LightEstimator::add().
    /// Returns the new light if LightEstimator::add() used this frame, otherwise nothing.
    std::optional<Lighting> follow(const ImageView& frame, const CameraModel& camera,
                                   const RigidTransform& T_world_camera, Timestamp time);

private:
    LightEstimator estimator_;
    std::optional<Sun> sun_;
    std::optional<Timestamp> seen_;
};

}  // namespace mfar
