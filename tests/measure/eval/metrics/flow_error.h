#pragma once

#include "tests/measure/eval/metrics/sparsification.h"

#include <opencv2/core.hpp>

#include <cstddef>

namespace mfar::eval {

/// How far a flow field is from the truth, over the pixels whose truth is known. NaN when none is.
struct FlowError {
    double epe = 0;       ///< mean end-point error of the covered pixels [px]
    double bad1 = 0;      ///< share off by more than 1 px; a pixel without an answer counts as off
    double bad2 = 0;      ///< share off by more than 2 px, likewise
    double coverage = 0;  ///< share of the known pixels with a finite answer
    double angular = 0;   ///< mean angle between (u, v, 1) of both, of the covered pixels [degrees]
    std::size_t known = 0;
};

/// Both CV_32FC2 [px] of the same size. Truth above 1e9 or not finite means unknown (the .flo
/// convention); an answer that is not finite means none was given.
[[nodiscard]] FlowError flowError(const cv::Mat& flow, const cv::Mat& truth);

/// Whether end-point errors are large where the confidence is low, over the covered pixels with
/// known truth. `confidence`: CV_32F of the same size.
[[nodiscard]] Sparsification flowSparsification(const cv::Mat& flow, const cv::Mat& truth,
                                                const cv::Mat& confidence);

}  // namespace mfar::eval
