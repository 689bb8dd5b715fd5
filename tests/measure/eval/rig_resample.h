#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Size of the super-resolved picture: the still's width at the video's aspect ratio.
[[nodiscard]] Size outputSize(const StereoRig& rig);

/// The video camera's view at `size` pixels, in the still camera: CV_32FC2, for each pixel the
/// still pixel that shows the same point of an infinitely far scene (rotation, intrinsics and
/// distortion; no translation). Points behind the still camera get (-1e6, -1e6).
[[nodiscard]] cv::Mat stillMap(const StereoRig& rig, Size size);

/// The still transformed to the video's geometry and resolution, area-averaged. Same type as the
/// still; parts that the still does not see repeat its border.
[[nodiscard]] cv::Mat resampleStill(const cv::Mat& still, const StereoRig& rig);

/// Map from output pixels of an up-scaled picture to still pixels, for peers that move the look-up
/// by a flow: base(P) + up(M(p + flow(p)) - M(p)) with M = stillMap at video size. The difference
/// is smooth, so bilinear up-scaling loses no accuracy where depth does not matter. `flow` in video
/// pixels.
[[nodiscard]] cv::Mat stillShift(const cv::Mat& videoMap, const cv::Mat& flow);

}  // namespace mfar::eval
