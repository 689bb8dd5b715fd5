#pragma once

#include "base/geometry.h"
#include "base/se3.h"

namespace mfar {

/// Relative pose of another picture and a frame. Its unit of length is the distance between the two
/// cameras, so that a search does not depend on the unit of the poses (metres or millimetres).
struct UnitPose {
    RigidTransform T_other_frame;
    Matrix6 covariance;  ///< of a small motion x in T_other_frame * exp(x)
    double unit = 1;     ///< distance between the cameras [unit of length of the poses]
    /// Relative standard deviation of the distance between the cameras. Refining the pose does not
    /// reduce it, because matches cannot determine the distance.
    double lengthError = 0;
};

/// Returns the relative pose. `other` and `frame` are the poses of the video camera at the times of
/// the other picture and of the frame. `T_camera_video` transforms video camera coordinates to
/// those of the other picture's camera. A distance within the rounding error of the positions
/// counts as 0.
[[nodiscard]] UnitPose unitPose(const RigidTransform& T_camera_video, const Pose& other,
                                const Pose& frame);

}  // namespace mfar
