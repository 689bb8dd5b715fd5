#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Rec. 601 luma of an 8-bit picture: 0.299 R + 0.587 G + 0.114 B. The picture has three channels
/// in OpenCV's order B G R, or one channel, which is copied. Returns CV_64F in [0, 255], not
/// rounded. Throws std::invalid_argument for any other type.
[[nodiscard]] cv::Mat luma(const cv::Mat& picture);

}  // namespace mfar::eval
