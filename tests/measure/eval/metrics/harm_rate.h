#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Share of the pixels of `picture` that are worse than bicubic enlargement: their error exceeds
/// that of `bicubic` by more than `tolerance` grey levels. All pictures are CV_64F in grey levels,
/// of the same size.
[[nodiscard]] double harmRate(const cv::Mat& picture, const cv::Mat& bicubic, const cv::Mat& truth,
                              double tolerance = 2);

}  // namespace mfar::eval
