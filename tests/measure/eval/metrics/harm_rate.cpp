#include "tests/measure/eval/metrics/harm_rate.h"

namespace mfar::eval {

double harmRate(const cv::Mat& picture, const cv::Mat& bicubic, const cv::Mat& truth,
                double tolerance) {
    CV_Assert(picture.size() == truth.size() && bicubic.size() == truth.size());
    const cv::Mat excess = cv::abs(picture - truth) - cv::abs(bicubic - truth);
    return cv::countNonZero(excess > tolerance) / static_cast<double>(truth.total());
}

}  // namespace mfar::eval
