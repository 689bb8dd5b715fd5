#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Structural similarity (Wang et al. 2004): Gaussian window 11x11 of sigma 1.5, K1 = 0.01,
/// K2 = 0.03, L = 255, mean over the windows that lie wholly inside, no down-sampling before.
/// Both CV_64F in grey levels, same size, at least 11x11 pixels.
[[nodiscard]] double ssim(const cv::Mat& picture, const cv::Mat& truth);

}  // namespace mfar::eval
