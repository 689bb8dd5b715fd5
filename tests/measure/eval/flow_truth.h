#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// True flow of a scene at rest, as defined by FlowField in pipeline/results.h: video pixel p shows
/// what pixel p + flow(p) of the still shows after transformation to the video's geometry (the
/// rig's rotation and both lenses, no parallax). CV_32FC2 [video px]. With T_still_video of the
/// shots = [R|t] and R_s the rig's rotation: p + flow = project_video(R_s^T (R ray + rho t)).
///
/// NaN where the inverse depth is unknown, outside the still's picture, and where the truth,
/// projected into the still, has a surface in front that is nearer by more than one pixel of
/// parallax. `inverseDepth` has the video's size, 1/m; `T_still_frame` maps video camera
/// coordinates at the frame's time to still camera coordinates at the still's time.
[[nodiscard]] cv::Mat flowOfInverseDepth(const FloatImage& inverseDepth, const StereoRig& rig,
                                         const RigidTransform& T_still_frame);

}  // namespace mfar::eval
