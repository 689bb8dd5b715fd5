#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <cstddef>

namespace mfar::eval {

/// Errors of a flow field over the pixels with known truth. NaN if there are none.
struct FlowError {
    double epe = 0;       ///< mean end-point error of the covered pixels [px]
    double bad1 = 0;      ///< share with an error above 1 px; a pixel without a result counts as an
                          ///< error
    double bad2 = 0;      ///< likewise above 2 px
    double coverage = 0;  ///< share of the known pixels with a finite result
    double angular = 0;   ///< mean angle between (u, v, 1) of result and truth over the covered
                          ///< pixels [degrees]
    std::size_t known = 0;
};

/// Both CV_32FC2 [px], same size. Truth above 1e9 or not finite is unknown (the .flo convention); a
/// result that is not finite is missing.
[[nodiscard]] FlowError flowError(const cv::Mat& flow, const cv::Mat& truth);

/// Whether end-point errors are large where the confidence is low, over covered pixels with known
/// truth. `confidence`: CV_32F, same size.
[[nodiscard]] Sparsification flowSparsification(const cv::Mat& flow, const cv::Mat& truth,
                                                const cv::Mat& confidence);

}  // namespace mfar::eval
