#pragma once

#include "pipeline/models/light_estimate.h"

#include <optional>

namespace mfar {

/// Updates the light of a scene from the camera's pictures, twice a second.
class LightFollower {
public:
    /// If `sun` is set, it is always used instead of an estimated sun.
    explicit LightFollower(const std::optional<Sun>& sun) : sun_(sun) {}

    /// Adds a frame as LightEstimator::add() does, at most twice a second. Returns the new light if
    /// a frame was added.
    std::optional<Lighting> follow(const ImageView& frame, const CameraModel& camera,
                                   const RigidTransform& T_world_camera, Timestamp time);

private:
    LightEstimator estimator_;
    std::optional<Sun> sun_;
    std::optional<Timestamp> seen_;
};

}  // namespace mfar
