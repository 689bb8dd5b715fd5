#pragma once

#include "base/geometry.h"
#include "base/se3.h"

namespace mfar {

/// Relative pose of a picture and a frame, in units of the distance between their cameras: in
/// metres and in millimetres a search then does the same.
struct UnitPose {
    RigidTransform T_other_frame;
    Matrix6 covariance;  ///< of a small motion x, T_other_frame * exp(x)
    double unit = 1;     ///< [unit of length of the poses]
    /// Standard deviation of the distance, as a share of it: no match can tell it.
    double lengthError = 0;
};

/// `other`, `frame`: where the video camera was at both times. `T_camera_video`: of the camera that
/// took the other picture. A distance that the positions' own rounding leaves is none.
[[nodiscard]] UnitPose unitPose(const RigidTransform& T_camera_video, const Pose& other,
                                const Pose& frame);

}  // namespace mfar
