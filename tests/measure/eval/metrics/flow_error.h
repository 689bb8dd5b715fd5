#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <cstddef>

namespace mfar::eval {

/// Errors of a flow over the pixels with known truth; NaN without such pixels. Covered pixels have
/// a finite result.
struct FlowError {
    double epe = 0;   ///< mean end-point error of covered pixels [px]
    double bad1 = 0;  ///< share of pixels without a result, or with an error above 1 px
    double bad2 = 0;  ///< share of pixels without a result, or with an error above 2 px
    double coverage = 0;
    /// Mean angle between flow and truth as vectors (u, v, 1), over covered pixels [degrees].
    double angular = 0;
    std::size_t known = 0;
};

/// `flow`, `truth`: CV_32FC2 [px], same size. Truth is unknown if it is not finite or above 1e9, as
/// in .flo files. A result that is not finite is missing.
[[nodiscard]] FlowError flowError(const cv::Mat& flow, const cv::Mat& truth);

/// Tells if end-point errors are large where the confidence is low. Counts only covered pixels with
/// known truth. `confidence`: CV_32F, same size.
[[nodiscard]] Sparsification flowSparsification(const cv::Mat& flow, const cv::Mat& truth,
                                                const cv::Mat& confidence);

}  // namespace mfar::eval
