#pragma once

#include <opencv2/core.hpp>

#include <cstddef>

namespace mfar::eval {

/// How far inverse depths are from the truth, over the pixels whose truth is known. NaN when there
/// are none.
struct DepthError {
    double absrel = 0;        ///< median of |z - true z| / true z where depth is known
    double bad1 = 0;          ///< share off by more than 1 px of disparity; unknown counts as off
    double completeness = 0;  ///< share of the pixels whose depth is known
    std::size_t pixels = 0;   ///< with known truth
};

/// `rho` and `truth`: CV_32F [1/m] of the same size, known where above 0. `disparity`: of a point
/// at 1 m [px]. Only where `mask` (CV_8U) is set.
[[nodiscard]] DepthError depthError(const cv::Mat& rho, const cv::Mat& truth, double disparity,
                                    const cv::Mat& mask);

/// CV_8U, set within `reach` px of an edge: where true depths side by side differ by a tenth.
[[nodiscard]] cv::Mat nearDepthEdge(const cv::Mat& truth, double reach);

}  // namespace mfar::eval
