#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Keys' cubic (a = -1/2), stretched when shrinking so that nothing aliases, the border reflected
/// with its edge repeated: what hdrVdp() was calibrated with. CV_64F, both sides at least 1.
[[nodiscard]] cv::Mat bicubicResize(const cv::Mat& picture, cv::Size size);

}  // namespace mfar::eval
