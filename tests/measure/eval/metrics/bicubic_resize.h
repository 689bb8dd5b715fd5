#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Resizes with Keys' cubic (a = -1/2). For shrinking, the kernel is widened to avoid aliasing. The
/// border is reflected, with its edge repeated. hdrVdp() was calibrated with this filter. CV_64F,
/// both sides at least 1.
[[nodiscard]] cv::Mat bicubicResize(const cv::Mat& picture, cv::Size size);

}  // namespace mfar::eval
