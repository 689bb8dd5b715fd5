#pragma once

#include "base/geometry.h"
#include "base/se3.h"

namespace mfar {

/// Relative pose of a picture and a frame, in units of the distance between their cameras, so that
/// a search is independent of the poses' unit of length (metres or millimetres).
struct UnitPose {
    RigidTransform T_other_frame;
    Matrix6 covariance;  ///< of a small motion x, T_other_frame * exp(x)
    double unit = 1;     ///< [unit of length of the poses]
    /// Standard deviation of the distance, relative to it: matches cannot determine it.
    double lengthError = 0;
};

/// `other`, `frame`: poses of the video camera at both times. `T_camera_video`: of the camera that
/// took the other picture. A distance within the rounding error of the positions counts as zero.
[[nodiscard]] UnitPose unitPose(const RigidTransform& T_camera_video, const Pose& other,
                                const Pose& frame);

}  // namespace mfar
