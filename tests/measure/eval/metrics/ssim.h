#pragma once

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Structural similarity (Wang et al. 2004): an 11x11 Gaussian window of sigma 1.5, K1 = 0.01, K2 =
/// 0.03, L = 255. Returns the mean over all windows inside the picture. The pictures are not
/// down-sampled first. Both CV_64F in grey levels, same size, at least 11x11 pixels.
[[nodiscard]] double ssim(const cv::Mat& picture, const cv::Mat& truth);

/// Multi-scale form (Wang, Simoncelli, Bovik 2003), with five scales and the weights of that paper.
/// A scale is the mean of 2x2 pixels of the scale before; an odd last row or column is dropped.
/// Luminance counts only at the coarsest scale. A scale whose contrast and structure are negative
/// counts as 0. Both sides at least 176 pixels.
[[nodiscard]] double msSsim(const cv::Mat& picture, const cv::Mat& truth);
inline constexpr int kMsSsimSmallestSide = 176;

}  // namespace mfar::eval
