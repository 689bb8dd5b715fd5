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

/// Map from pixels of the enlarged picture to still pixels, for peers that move the look-up by a
/// flow: base(P) + up(M(p + flow(p)) - M(p)), where M is stillMap() at video size and `up` enlarges
/// bilinearly. The difference is smooth; so enlarging it loses no accuracy except at depth edges.
/// `flow`: [video px].
[[nodiscard]] cv::Mat stillShift(const cv::Mat& videoMap, const cv::Mat& flow);

}  // namespace mfar::eval
