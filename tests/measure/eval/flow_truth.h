#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// True flow of a scene at rest, CV_32FC2 [video px], as defined by FlowField in
/// pipeline/results.h. Video pixel p and pixel p + flow(p) of the resampled still show the same
/// point. Resampling uses the rig's rotation R_s and both lenses, but no parallax: p + flow =
/// project_video(R_s^T (R ray + s t)). [R|t] = T_still_frame maps video camera coordinates at the
/// frame's time to still camera coordinates at the still's time; s is the inverse depth [1/m].
///
/// The flow is NaN where the inverse depth is unknown, and where the point is outside or occluded
/// in the still. A point is occluded if another surface of the frame lies in front of it by more
/// than one pixel of parallax. `inverseDepth` has the video's size.
[[nodiscard]] cv::Mat flowOfInverseDepth(const FloatImage& inverseDepth, const StereoRig& rig,
                                         const RigidTransform& T_still_frame);

}  // namespace mfar::eval
