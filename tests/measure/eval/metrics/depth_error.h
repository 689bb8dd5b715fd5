#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>

namespace mfar::eval {

/// Errors of inverse depths over the pixels with known truth. NaN if no pixel has one.
struct DepthError {
    double absrel = 0;  ///< median of |z - true z| / true z over pixels with known depth
    double bad1 = 0;    ///< share of pixels off by more than 1 px of disparity or without depth
    double completeness = 0;  ///< share of the pixels with known depth
    std::size_t pixels = 0;   ///< pixels with known truth
    /// Shares of the pixels whose depth and true depth differ by less than a factor of 1.25, 1.25^2
    /// and 1.25^3. Pixels with unknown depth count as different.
    std::array<double, 3> delta{};
};

/// `rho`, `truth`: inverse depth, CV_32F [1/m], same size; known if above 0. `disparity`: disparity
/// of a point at 1 m [px]. Only pixels where `mask` (CV_8U) is set count.
[[nodiscard]] DepthError depthError(const cv::Mat& rho, const cv::Mat& truth, double disparity,
                                    const cv::Mat& mask);

/// Tells whether disparity errors are large where the variance of the inverse depth is large. Only
/// pixels with both depths known count. `variance`: CV_32F [1/m^2], finite at these pixels.
[[nodiscard]] Sparsification depthSparsification(const cv::Mat& rho, const cv::Mat& variance,
                                                 const cv::Mat& truth, double disparity);

/// CV_8U: set within `reach` px of a depth edge. At an edge, neighbouring true depths differ by
/// more than a tenth.
[[nodiscard]] cv::Mat nearDepthEdge(const cv::Mat& truth, double reach);

}  // namespace mfar::eval
