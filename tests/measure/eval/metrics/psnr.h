#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Mean squared error of two CV_64F pictures of the same size [grey levels^2].
[[nodiscard]] double meanSquaredError(const cv::Mat& picture, const cv::Mat& truth);

/// Peak signal-to-noise ratio with a peak of 255 [dB]; +infinity for equal pictures. Both pictures
/// are CV_64F in grey levels, of the same size.
[[nodiscard]] double psnr(const cv::Mat& picture, const cv::Mat& truth);

}  // namespace mfar::eval
