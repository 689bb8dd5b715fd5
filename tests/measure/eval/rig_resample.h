#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Size of the super-resolved picture: the still's width at the video's aspect ratio.
[[nodiscard]] Size outputSize(const StereoRig& rig);

/// Maps the video camera's view, at `size` pixels, to the still. For each pixel, returns the still
/// pixel that shows the same infinitely distant point, CV_32FC2. Points behind the still camera get
/// (-1e6, -1e6).
[[nodiscard]] cv::Mat stillMap(const StereoRig& rig, Size size);

/// Resamples the still to the video's geometry and resolution by area means. The result has the
/// still's type. Parts outside the still repeat its border.
[[nodiscard]] cv::Mat resampleStill(const cv::Mat& still, const StereoRig& rig);

/// Returns M(p + flow(p)) - M(p) for each video pixel p [still px]. M is `videoMap`, the stillMap()
/// at the video's size; `flow` is in video px. Peers enlarge this difference bilinearly and add it
/// to the stillMap() of the enlarged picture. The difference is smooth except at depth edges, so
/// enlarging it is inexact only there.
[[nodiscard]] cv::Mat stillShift(const cv::Mat& videoMap, const cv::Mat& flow);

}  // namespace mfar::eval
