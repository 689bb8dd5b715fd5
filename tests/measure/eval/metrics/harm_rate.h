#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Share of the pixels whose error exceeds that of plain bicubic enlargement by more than
/// `tolerance` grey levels. At these pixels the method did harm. All pictures CV_64F in grey
/// levels, same size.
[[nodiscard]] double harmRate(const cv::Mat& picture, const cv::Mat& bicubic, const cv::Mat& truth,
                              double tolerance = 2);

}  // namespace mfar::eval
