#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Resizes a CV_64F picture with Keys' cubic (a = -1/2), the filter with which hdrVdp() was
/// calibrated. Shrinking widens the kernel to avoid aliasing. The border is reflected, with its
/// edge repeated.
[[nodiscard]] cv::Mat bicubicResize(const cv::Mat& picture, cv::Size size);

}  // namespace mfar::eval
