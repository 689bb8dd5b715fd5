#pragma once

#include "base/geometry.h"
#include "base/se3.h"

namespace mfar {

/// Relative pose between another picture and a frame. The unit of length is the distance between
/// the two cameras. If this distance is 0, the unit is the unit of the tracked poses. A search with
/// this pose does not depend on the unit of the tracked poses (metres or millimetres).
struct UnitPose {
    RigidTransform T_other_frame;
    Matrix6 covariance;  ///< covariance of a small motion x in T_other_frame * exp(x)
    /// Distance between the cameras [unit of length of the tracked poses], or 1 if it is 0.
    double unit = 1;
    /// Relative standard deviation of the distance between the cameras. Refining the pose does not
    /// reduce it, because matches do not determine this distance.
    double lengthError = 0;
};

/// Returns the relative pose. `other` and `frame` are the poses of the video camera at the times of
/// the other picture and of the frame. `T_camera_video` transforms video camera coordinates to
/// coordinates of the camera that took the other picture. If the distance between the cameras is
/// within the rounding error of their positions, it counts as 0.
[[nodiscard]] UnitPose unitPose(const RigidTransform& T_camera_video, const Pose& other,
                                const Pose& frame);

/// As unitPose(), for a video camera that has not moved between the two pictures, as far as the
/// pictures show. The relative pose is then T_camera_video, and the errors of both poses do not
/// matter. If the poses differ by more than their covariances explain, returns unitPose().
[[nodiscard]] UnitPose restingPose(const RigidTransform& T_camera_video, const Pose& other,
                                   const Pose& frame);

}  // namespace mfar
