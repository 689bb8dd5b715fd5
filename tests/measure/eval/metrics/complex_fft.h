#pragma once

#include "tests/measure/eval/metrics/fftw_plan.h"

#include <opencv2/core.hpp>

namespace mfar::eval {

/// Complex two-dimensional Fourier transform of CV_64FC2 pictures of one size, in place, not
/// scaled. Only one thread may construct an object at a time; run() is thread-safe.
class ComplexFft {
public:
    enum class Direction { Forward, Inverse };
    ComplexFft(cv::Size size, Direction direction);
    void run(cv::Mat& values) const;

private:
    cv::Size size_;
    FftwPlan plan_;
};

}  // namespace mfar::eval
