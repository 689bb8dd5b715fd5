#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// True flow of a scene at rest, as defined by FlowField in pipeline/results.h: video pixel p and
/// still pixel p + flow(p) show the same point, if the still is resampled to the video's geometry.
/// Resampling uses the rig's rotation and both lenses, but no parallax:
/// p + flow = project_video(R_s^T (R ray + rho t)). [R|t] = T_still_frame maps video camera
/// coordinates at the frame's time to still camera coordinates at the still's time. R_s is the
/// rig's rotation, and rho the inverse depth [1/m]. Returns CV_32FC2 [video px].
///
/// The flow is NaN where the inverse depth is unknown, where the point lies outside the still's
/// picture, and where it is occluded in the still: another surface of the frame, projected into the
/// still, lies in front of it by more than one pixel of parallax. `inverseDepth` has the video's
/// size.
[[nodiscard]] cv::Mat flowOfInverseDepth(const FloatImage& inverseDepth, const StereoRig& rig,
                                         const RigidTransform& T_still_frame);

}  // namespace mfar::eval
