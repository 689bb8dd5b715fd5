#include "tests/eval/metrics/flow_error.h"

#include <cmath>

namespace mfar::eval {
namespace {

bool isKnown(const cv::Vec2f& v) {
    return std::abs(v[0]) < 1e9F && std::abs(v[1]) < 1e9F;
}

}  // namespace

FlowError flowError(const cv::Mat& flow, const cv::Mat& truth) {
    CV_Assert(flow.type() == CV_32FC2 && truth.type() == CV_32FC2 && flow.size() == truth.size());
    double sum = 0;
    std::size_t known = 0, covered = 0, off1 = 0, off2 = 0;
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.cols; ++x) {
            const auto& wanted = truth.at<cv::Vec2f>(y, x);
            if (!isKnown(wanted)) continue;
            ++known;
            const auto& got = flow.at<cv::Vec2f>(y, x);
            const double error = std::hypot(static_cast<double>(got[0]) - wanted[0],
                                            static_cast<double>(got[1]) - wanted[1]);
            if (!(error <= 1)) ++off1;
            if (!(error <= 2)) ++off2;
            if (!std::isfinite(error)) continue;
            ++covered;
            sum += error;
        }
    const auto total = static_cast<double>(known);
    return {sum / static_cast<double>(covered), static_cast<double>(off1) / total,
            static_cast<double>(off2) / total, static_cast<double>(covered) / total, known};
}

}  // namespace mfar::eval
