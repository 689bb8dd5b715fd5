#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>

namespace mfar::eval {

/// Errors of inverse depths over the pixels with known truth. NaN if there are none.
struct DepthError {
    double absrel = 0;        ///< median of |z - true z| / true z over pixels with known depth
    double bad1 = 0;          ///< share with a disparity error above 1 px; unknown depth counts as
                              ///< an error
    double completeness = 0;  ///< share of the pixels with known depth
    std::size_t pixels = 0;   ///< pixels with known truth
    /// Shares with z and true z within a factor of 1.25, 1.25^2 and 1.25^3 of each other; unknown
    /// depth counts as beyond.
    std::array<double, 3> delta{};
};

/// `rho` and `truth`: inverse depth, CV_32F [1/m], same size, known if above 0. `disparity`: of a
/// point at 1 m [px]. Only pixels where `mask` (CV_8U) is set count.
[[nodiscard]] DepthError depthError(const cv::Mat& rho, const cv::Mat& truth, double disparity,
                                    const cv::Mat& mask);

/// Whether disparity errors are large where the variance of the inverse depth is large, over the
/// pixels with both depths known. `variance`: CV_32F [1/m^2], finite there.
[[nodiscard]] Sparsification depthSparsification(const cv::Mat& rho, const cv::Mat& variance,
                                                 const cv::Mat& truth, double disparity);

/// CV_8U, set within `reach` px of an edge: where neighbouring true depths differ by a tenth.
[[nodiscard]] cv::Mat nearDepthEdge(const cv::Mat& truth, double reach);

}  // namespace mfar::eval
