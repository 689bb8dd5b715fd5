#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <array>
#include <cstddef>

namespace mfar::eval {

/// Errors of inverse depth over the pixels with known truth; NaN without such pixels.
struct DepthError {
    double absrel = 0;  ///< median of |z - true z| / true z over pixels with known depth
    double bad1 = 0;    ///< share of pixels without depth, or with disparity off by more than 1 px
    double completeness = 0;
    std::size_t pixels = 0;
    /// Shares of pixels whose depth differs from the truth by less than a factor of 1.25, 1.25^2
    /// and 1.25^3. Pixels without depth count as different.
    std::array<double, 3> delta{};
};

/// `inverseDepth`, `truth`: inverse depth, CV_32F [1/m], same size; known if above 0. `disparity`:
/// disparity of a point at 1 m [px]. Only pixels where `mask` (CV_8U) is not 0 are counted.
[[nodiscard]] DepthError depthError(const cv::Mat& inverseDepth, const cv::Mat& truth,
                                    double disparity, const cv::Mat& mask);

/// Tells if disparity errors are large where `variance`, the variance of `inverseDepth`, is large.
/// Counts only pixels with known depth and truth. `variance`: CV_32F [1/m^2], finite at these
/// pixels.
[[nodiscard]] Sparsification depthSparsification(const cv::Mat& inverseDepth,
                                                 const cv::Mat& variance, const cv::Mat& truth,
                                                 double disparity);

/// Returns a CV_8U mask that is not 0 within `reach` px of a depth edge. At a depth edge, the true
/// depths of neighbouring pixels differ by more than a tenth.
[[nodiscard]] cv::Mat nearDepthEdge(const cv::Mat& truth, double reach);

}  // namespace mfar::eval
