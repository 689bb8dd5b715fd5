#include "tests/measure/eval/metrics/depth_error.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mfar::eval {
namespace {

constexpr float kStep = 1.1F;    // larger ratios of neighbouring depths are edges
constexpr double kDelta = 1.25;  // base of the thresholds of delta (Eigen et al. 2014)

bool isKnown(float inverseDepth) {
    return inverseDepth > 0 && std::isfinite(inverseDepth);
}

bool isStep(float a, float b) {
    return isKnown(a) && isKnown(b) && std::max(a, b) > kStep * std::min(a, b);
}

double median(std::vector<double>& values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

DepthError depthError(const cv::Mat& inverseDepth, const cv::Mat& truth, double disparity,
                      const cv::Mat& mask) {
    CV_Assert(inverseDepth.type() == CV_32F && truth.type() == CV_32F &&
              inverseDepth.size() == truth.size());
    CV_Assert(mask.type() == CV_8U && mask.size() == truth.size());
    std::vector<double> relative;
    std::size_t pixels = 0, off = 0;
    std::array<double, 3> within{};
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.cols; ++x) {
            const float wanted = truth.at<float>(y, x), got = inverseDepth.at<float>(y, x);
            if (mask.at<uchar>(y, x) == 0 || !isKnown(wanted)) continue;
            ++pixels;
            const bool known = isKnown(got);
            if (known) relative.push_back(std::abs(static_cast<double>(wanted) / got - 1));
            if (!known || std::abs(static_cast<double>(got) - wanted) * disparity > 1) ++off;
            if (!known) continue;
            const double ratio = std::max(got, wanted) / std::min(got, wanted);
            for (std::size_t k = 0; k < within.size(); ++k)
                if (ratio < std::pow(kDelta, k + 1)) ++within[k];
        }
    const auto all = static_cast<double>(pixels);
    const auto known = static_cast<double>(relative.size());
    for (double& share : within)
        share /= all;
    return {median(relative), static_cast<double>(off) / all, known / all, pixels, within};
}

Sparsification depthSparsification(const cv::Mat& inverseDepth, const cv::Mat& variance,
                                   const cv::Mat& truth, double disparity) {
    CV_Assert(inverseDepth.type() == CV_32F && truth.type() == CV_32F &&
              inverseDepth.size() == truth.size());
    CV_Assert(variance.type() == CV_32F && variance.size() == truth.size());
    std::vector<float> errors, trust;
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.cols; ++x) {
            const float wanted = truth.at<float>(y, x), got = inverseDepth.at<float>(y, x);
            if (!isKnown(wanted) || !isKnown(got)) continue;
            errors.push_back(static_cast<float>(std::abs(got - wanted) * disparity));
            trust.push_back(-variance.at<float>(y, x));
        }
    return sparsification(errors, trust);
}

cv::Mat nearDepthEdge(const cv::Mat& truth, double reach) {
    cv::Mat away(truth.size(), CV_8U, cv::Scalar(255)), distance;
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.cols; ++x)
            for (const cv::Point next : {cv::Point(x + 1, y), cv::Point(x, y + 1)})
                if (next.x < truth.cols && next.y < truth.rows &&
                    isStep(truth.at<float>(y, x), truth.at<float>(next)))
                    away.at<uchar>(y, x) = away.at<uchar>(next) = 0;
    cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return distance <= reach;
}

}  // namespace mfar::eval
