#pragma once

#include "tests/measure/eval/metrics/fftw_plan.h"

#include <opencv2/core.hpp>

#include <functional>

namespace mfar::eval {

/// A filter whose gain depends on spatial frequency alone, for pictures of one size. They are
/// padded to twice their size, so that opposite borders do not reach each other.
class RadialFilter {
public:
    /// `gain` of a frequency [cycles/degree], called from several threads. Not thread-safe, as
    /// FFTW's planner is not.
    RadialFilter(cv::Size size, double pixelsPerDegree, const std::function<double(double)>& gain);

    /// CV_64F of the size given -> the same filtered, as if it were surrounded by `padding` at the
    /// right and below. Thread-safe.
    [[nodiscard]] cv::Mat apply(const cv::Mat& picture, double padding) const;

private:
    cv::Size size_;
    cv::Mat gain_;  // of the frequencies that are not negative, times the scale of the transform
    FftwPlan forward_, backward_;
};

}  // namespace mfar::eval
