#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <cstddef>

namespace mfar::eval {

/// Errors of a flow field over the pixels with known truth. NaN if no pixel has one.
struct FlowError {
    double epe = 0;       ///< mean end-point error of the covered pixels [px]
    double bad1 = 0;      ///< share of the pixels with an error above 1 px or without a result
    double bad2 = 0;      ///< share of the pixels with an error above 2 px or without a result
    double coverage = 0;  ///< share of the known pixels with a finite result
    double angular = 0;   ///< mean angle of (u, v, 1) to the truth, covered pixels [degrees]
    std::size_t known = 0;
};

/// Both CV_32FC2 [px], same size. Truth is unknown if it is not finite or above 1e9 (the convention
/// of .flo files). A result that is not finite is missing.
[[nodiscard]] FlowError flowError(const cv::Mat& flow, const cv::Mat& truth);

/// Tells whether end-point errors are large where the confidence is low. Only covered pixels with
/// known truth count. `confidence`: CV_32F, same size.
[[nodiscard]] Sparsification flowSparsification(const cv::Mat& flow, const cv::Mat& truth,
                                                const cv::Mat& confidence);

}  // namespace mfar::eval
