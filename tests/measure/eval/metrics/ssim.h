#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Structural similarity (Wang et al. 2004): 11x11 Gaussian window of sigma 1.5, K1 = 0.01, K2 =
/// 0.03, L = 255, mean over the windows inside the picture, without prior down-sampling. Both
/// CV_64F in grey levels, same size, at least 11x11 pixels.
[[nodiscard]] double ssim(const cv::Mat& picture, const cv::Mat& truth);

/// Multi-scale form (Wang, Simoncelli, Bovik 2003): five scales, each the mean of 2x2 pixels of the
/// one before (an odd last row or column is dropped), with the weights of that paper; luminance
/// only at the coarsest. A scale with negative contrast and structure counts as 0. Both sides at
/// least 176 pixels.
[[nodiscard]] double msSsim(const cv::Mat& picture, const cv::Mat& truth);
inline constexpr int kMsSsimSmallestSide = 176;

}  // namespace mfar::eval
