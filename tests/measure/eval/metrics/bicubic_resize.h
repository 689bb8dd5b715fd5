#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Keys' cubic (a = -1/2), widened for shrinking to avoid aliasing; the border is reflected with
/// its edge repeated. hdrVdp() was calibrated with it. CV_64F, both sides at least 1.
[[nodiscard]] cv::Mat bicubicResize(const cv::Mat& picture, cv::Size size);

}  // namespace mfar::eval
