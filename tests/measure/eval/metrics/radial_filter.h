#pragma once

#include "tests/measure/eval/metrics/fftw_plan.h"

#include <opencv2/core.hpp>

#include <functional>

namespace mfar::eval {

/// A filter for pictures of one size, whose gain depends only on the spatial frequency. Pictures
/// are padded to twice their size, so that opposite borders do not affect each other.
class RadialFilter {
public:
    /// `gain` takes a frequency [cycles/degree] and must be thread-safe. Two filters must not be
    /// constructed at the same time, because FFTW's planner is not thread-safe.
    RadialFilter(cv::Size size, double pixelsPerDegree, const std::function<double(double)>& gain);

    /// Filters a CV_64F picture, padded at the right and below with the value `padding`.
    /// Thread-safe.
    [[nodiscard]] cv::Mat apply(const cv::Mat& picture, double padding) const;

private:
    cv::Size size_;
    cv::Mat gain_;  // gain at non-negative frequencies, times the scale of the transform
    FftwPlan forward_, backward_;
};

}  // namespace mfar::eval
