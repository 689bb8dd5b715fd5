#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Rec. 601 luma of an 8-bit picture: 0.299 R + 0.587 G + 0.114 B, CV_64F in [0, 255], not rounded.
/// The picture has three channels B G R, or one channel, which is copied. Throws
/// std::invalid_argument for other types.
[[nodiscard]] cv::Mat luma(const cv::Mat& picture);

}  // namespace mfar::eval
