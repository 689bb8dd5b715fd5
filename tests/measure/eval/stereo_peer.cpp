#include "tests/measure/eval/stereo_peer.h"

#include "tests/measure/eval/rectification.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/stopwatch.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar::eval {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The penalties for changes of the disparity are those that OpenCV's documentation recommends.
cv::Ptr<cv::StereoMatcher> createMatcher(int disparities, StereoPeer::Matcher matcher) {
    if (matcher == StereoPeer::Matcher::Block) return cv::StereoBM::create(disparities, 21);
    constexpr int kBlock = 5, kArea = kBlock * kBlock;
    return cv::StereoSGBM::create(0, disparities, kBlock, 8 * kArea, 32 * kArea, 1, 31, 10, 0, 0,
                                  cv::StereoSGBM::MODE_SGBM_3WAY);
}

/// Fills the pixels [begin, end) of a row with the smaller one of the disparities at both ends of
/// this gap, because the smaller one is the background's.
void fillGap(float* row, int begin, int end, int width) {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    const float value =
        std::min(begin > 0 ? row[begin - 1] : kNone, end < width ? row[end] : kNone);
    std::fill(row + begin, row + end, value < kNone ? value : kNan);
}

cv::Mat filled(const cv::Mat& disparity) {
    cv::Mat out;
    disparity.convertTo(out, CV_32F, 1.0 / static_cast<int>(cv::StereoMatcher::DISP_SCALE));
    for (int y = 0; y < out.rows; ++y) {
        auto* row = out.ptr<float>(y);
        for (int x = 0; x < out.cols; ++x) {
            if (row[x] >= 0) continue;
            int end = x;
            while (end < out.cols && row[end] < 0)
                ++end;
            fillGap(row, x, end, out.cols);
            x = end;
        }
    }
    return out;
}

cv::Mat flowOf(const cv::Mat& disparity, const Rectification& views, const Size& size) {
    cv::Mat flow(size.height, size.width, CV_32FC2, cv::Scalar(kNan, kNan));
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Eigen::Vector2d place = views.ofFirst({x, y});
            const int u =
                std::clamp(static_cast<int>(std::lround(place.x())), 0, disparity.cols - 1);
            const int v =
                std::clamp(static_cast<int>(std::lround(place.y())), 0, disparity.rows - 1);
            const float d = disparity.at<float>(v, u);
            if (std::isnan(d)) continue;
            const Eigen::Vector2d seen = views.toSecond({place.x() - d, place.y()});
            flow.at<cv::Vec2f>(y, x) = {static_cast<float>(seen.x() - x),
                                        static_cast<float>(seen.y() - y)};
        }
    return flow;
}

}  // namespace

StereoPeer::StereoPeer(const StereoRig& rig, Matcher matcher)
    : rig_(rig), disparities_((rig.video.size.width / 6 + 15) / 16 * 16),
      matcher_(createMatcher(disparities_, matcher)) {}

void StereoPeer::setStill(const cv::Mat& still) {
    cv::cvtColor(resampleStill(still, rig_), still_, cv::COLOR_BGR2GRAY);
}

StereoPeer::Result StereoPeer::run(const cv::Mat& video, const RigidTransform& T_still_frame) {
    // The still is already resampled to the video's lens and orientation.
    const RigidTransform turn{rig_.T_still_video.rotation.conjugate(), {0, 0, 0}};
    const auto views = Rectification::of(rig_.video, turn * T_still_frame, disparities_);
    if (!views) return {cv::Mat(video.size(), CV_32FC2, cv::Scalar(kNan, kNan)), 0};
    const cv::Mat firstMap = views->firstMap(), secondMap = views->secondMap();
    cv::Mat grey, first, second, disparity;
    cv::cvtColor(video, grey, cv::COLOR_BGR2GRAY);
    const auto match = [&] {
        cv::remap(grey, first, firstMap, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
        cv::remap(still_, second, secondMap, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
        matcher_->compute(first, second, disparity);
    };
    match();
    return {flowOf(filled(disparity), *views, rig_.video.size),
            medianOfThree([&] { return methodMs(match); })};
}

}  // namespace mfar::eval
