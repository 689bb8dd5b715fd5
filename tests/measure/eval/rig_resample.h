#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Size of the super-resolved picture: the width of the still, at the aspect ratio of the video.
[[nodiscard]] Size outputSize(const StereoRig& rig);

/// The view of the video camera, at `size` pixels, in the still camera. For each pixel, the still
/// pixel that shows the same point of an infinitely distant scene (rotation, intrinsics and
/// distortion; no translation), CV_32FC2. Points behind the still camera get (-1e6, -1e6).
[[nodiscard]] cv::Mat stillMap(const StereoRig& rig, Size size);

/// Resamples the still to the video's geometry and resolution, with area means. The type is that of
/// the still. Parts that the still does not show repeat its border.
[[nodiscard]] cv::Mat resampleStill(const cv::Mat& still, const StereoRig& rig);

/// For peers that move look-ups in the still by a flow: returns M(p + flow(p)) - M(p) for each
/// video pixel p [still px], where M is `videoMap`, the stillMap() at video size. Peers enlarge
/// this difference bilinearly and add it to the stillMap() of the enlarged picture. The difference
/// is smooth; so enlarging it loses no accuracy except at depth edges. `flow`: [video px].
[[nodiscard]] cv::Mat stillShift(const cv::Mat& videoMap, const cv::Mat& flow);

}  // namespace mfar::eval
