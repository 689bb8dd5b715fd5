#include "tests/measure/eval/metrics/flow_error.h"

#include <cmath>
#include <vector>

namespace mfar::eval {
namespace {

bool isKnown(const cv::Vec2f& v) {
    return std::abs(v[0]) < 1e9F && std::abs(v[1]) < 1e9F;
}

/// Angle between two flows as directions in space and time (Barron et al. 1994) [degrees].
double angleBetween(const cv::Vec2d& a, const cv::Vec2d& b) {
    const cv::Vec3d x(a[0], a[1], 1), y(b[0], b[1], 1);
    return std::atan2(cv::norm(x.cross(y)), x.dot(y)) * 180 / CV_PI;
}

}  // namespace

FlowError flowError(const cv::Mat& flow, const cv::Mat& truth) {
    CV_Assert(flow.type() == CV_32FC2 && truth.type() == CV_32FC2 && flow.size() == truth.size());
    double sum = 0, angles = 0;
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
            angles += angleBetween(got, wanted);
        }
    const auto total = static_cast<double>(known);
    const auto answers = static_cast<double>(covered);
    return {sum / answers,
            static_cast<double>(off1) / total,
            static_cast<double>(off2) / total,
            answers / total,
            angles / answers,
            known};
}

Sparsification flowSparsification(const cv::Mat& flow, const cv::Mat& truth,
                                  const cv::Mat& confidence) {
    CV_Assert(flow.type() == CV_32FC2 && truth.type() == CV_32FC2 && flow.size() == truth.size());
    CV_Assert(confidence.type() == CV_32F && confidence.size() == truth.size());
    std::vector<float> errors, trust;
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.cols; ++x) {
            const auto &wanted = truth.at<cv::Vec2f>(y, x), &got = flow.at<cv::Vec2f>(y, x);
            const auto error = static_cast<float>(cv::norm(got - wanted));
            if (!isKnown(wanted) || !std::isfinite(error)) continue;
            errors.push_back(error);
            trust.push_back(confidence.at<float>(y, x));
        }
    return sparsification(errors, trust);
}

}  // namespace mfar::eval
