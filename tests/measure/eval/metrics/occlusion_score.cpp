#include "tests/measure/eval/metrics/occlusion_score.h"

#include <opencv2/imgproc.hpp>

#include <limits>

namespace mfar::eval {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kShown = 0.5;  // pixels with at least this visible share count as shown

cv::Mat boundaryOf(const cv::Mat& mask) {
    cv::Mat inner;
    cv::erode(mask, inner, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
    return cv::Mat(mask & ~inner);
}

}  // namespace

OcclusionScore occlusionScore(const cv::Mat& shown, const cv::Mat& truth) {
    CV_Assert(shown.type() == CV_8U && truth.type() == CV_8U && shown.size() == truth.size());
    const cv::Mat got = shown != 0, wanted = truth != 0;
    const int either = cv::countNonZero(got | wanted);
    if (either == 0) return {kNone, kNone};
    OcclusionScore out{static_cast<double>(cv::countNonZero(got & wanted)) / either, kNone};
    const cv::Mat edge = boundaryOf(got), trueEdge = boundaryOf(wanted);
    if (cv::countNonZero(edge) == 0 || cv::countNonZero(trueEdge) == 0) return out;
    cv::Mat distance;
    cv::distanceTransform(~trueEdge, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    out.boundary = cv::mean(distance, edge)[0];
    return out;
}

double flicker(const cv::Mat& before, const cv::Mat& now, double silhouette) {
    CV_Assert(before.type() == CV_32F && now.type() == CV_32F && before.size() == now.size());
    if (!(silhouette > 0)) return kNone;
    return cv::countNonZero((before >= kShown) ^ (now >= kShown)) / silhouette;
}

}  // namespace mfar::eval
