#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>

namespace mfar::eval {

/// How far inverse depths are from the truth, over the pixels whose truth is known. NaN when there
/// are none.
struct DepthError {
    double absrel = 0;        ///< median of |z - true z| / true z where depth is known
    double bad1 = 0;          ///< share off by more than 1 px of disparity; unknown counts as off
    double completeness = 0;  ///< share of the pixels whose depth is known
    std::size_t pixels = 0;   ///< with known truth
    /// Shares with z and true z within a factor of 1.25, its square and its cube of each other;
    /// unknown counts as beyond.
    std::array<double, 3> delta{};
};

/// `rho` and `truth`: CV_32F [1/m] of the same size, known where above 0. `disparity`: of a point
/// at 1 m [px]. Only where `mask` (CV_8U) is set.
[[nodiscard]] DepthError depthError(const cv::Mat& rho, const cv::Mat& truth, double disparity,
                                    const cv::Mat& mask);

/// Whether disparities are far off where the variance of the inverse depth is large, over the
/// pixels where both depths are known. `variance`: CV_32F [1/m^2], finite there.
[[nodiscard]] Sparsification depthSparsification(const cv::Mat& rho, const cv::Mat& variance,
                                                 const cv::Mat& truth, double disparity);

/// CV_8U, set within `reach` px of an edge: where true depths side by side differ by a tenth.
[[nodiscard]] cv::Mat nearDepthEdge(const cv::Mat& truth, double reach);

}  // namespace mfar::eval
