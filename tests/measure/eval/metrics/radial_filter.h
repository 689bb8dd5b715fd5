#pragma once

#include "tests/measure/eval/metrics/fftw_plan.h"

#include <opencv2/core.hpp>

#include <functional>

namespace mfar::eval {

/// A filter whose gain depends only on the spatial frequency, for pictures of one size. They are
/// padded to twice their size, so that opposite borders do not affect each other.
class RadialFilter {
public:
    /// `gain` for a frequency [cycles/degree] is called from several threads. Not thread-safe,
    /// because FFTW's planner is not.
    RadialFilter(cv::Size size, double pixelsPerDegree, const std::function<double(double)>& gain);

    /// CV_64F of the given size -> the filtered picture, as if it were surrounded by `padding` at
    /// the right and below. Thread-safe.
    [[nodiscard]] cv::Mat apply(const cv::Mat& picture, double padding) const;

private:
    cv::Size size_;
    cv::Mat gain_;  // at the frequencies that are not negative, times the scale of the transform
    FftwPlan forward_, backward_;
};

}  // namespace mfar::eval
