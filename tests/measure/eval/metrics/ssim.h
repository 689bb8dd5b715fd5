#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Structural similarity (Wang et al. 2004): 11x11 Gaussian window of sigma 1.5, K1 = 0.01, K2 =
/// 0.03, L = 255, without down-sampling. Returns the mean over all windows inside the picture. Both
/// pictures are CV_64F in grey levels, of the same size, at least 11x11 pixels.
[[nodiscard]] double ssim(const cv::Mat& picture, const cv::Mat& truth);

/// Multi-scale SSIM (Wang, Simoncelli, Bovik 2003), with five scales and the weights of that paper.
/// A pixel of a scale is the mean of 2x2 pixels of the previous, finer scale; an odd last row or
/// column is dropped. Luminance counts only at the coarsest scale. If the mean of a scale is
/// negative, the result is 0. Each side must have at least 176 pixels.
[[nodiscard]] double msSsim(const cv::Mat& picture, const cv::Mat& truth);
inline constexpr int kMsSsimSmallestSide = 176;

}  // namespace mfar::eval
