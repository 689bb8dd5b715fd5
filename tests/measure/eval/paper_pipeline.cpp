#include "tests/measure/eval/paper_pipeline.h"

#include "tests/measure/eval/rig_resample.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace mfar::eval {
namespace {

/// Replaces `a` by a + (b - a) weight / 255 in each channel. a and b are CV_8UC3, `weight` is
/// CV_8U.
void blendInto(cv::Mat& a, const cv::Mat& b, const cv::Mat& weight) {
    cv::parallel_for_({0, a.rows}, [&](const cv::Range& rows) {
        for (int y = rows.start; y < rows.end; ++y) {
            auto* to = a.ptr<cv::Vec3b>(y);
            const auto* from = b.ptr<cv::Vec3b>(y);
            const auto* w = weight.ptr<std::uint8_t>(y);
            for (int x = 0; x < a.cols; ++x)
                for (int c = 0; c < 3; ++c)
                    to[x][c] = static_cast<std::uint8_t>(
                        (to[x][c] * (255 - w[x]) + from[x][c] * w[x] + 127) / 255);
        }
    });
}

}  // namespace

cv::Ptr<cv::DISOpticalFlow> createDis(DisPreset preset) {
    return cv::DISOpticalFlow::create(preset == DisPreset::Fast
                                          ? cv::DISOpticalFlow::PRESET_FAST
                                          : cv::DISOpticalFlow::PRESET_MEDIUM);
}

cv::Mat twoWayConfidence(const cv::Mat& forward, const cv::Mat& backward, double alpha) {
    cv::Mat lookup(forward.size(), CV_32FC2), back, out(forward.size(), CV_32F);
    for (int y = 0; y < forward.rows; ++y)
        for (int x = 0; x < forward.cols; ++x)
            lookup.at<cv::Vec2f>(y, x) = forward.at<cv::Vec2f>(y, x) +
                                         cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    cv::remap(backward, back, lookup, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    const auto right = static_cast<float>(forward.cols - 1);
    const auto bottom = static_cast<float>(forward.rows - 1);
    for (int y = 0; y < forward.rows; ++y)
        for (int x = 0; x < forward.cols; ++x) {
            const auto& q = lookup.at<cv::Vec2f>(y, x);
            const bool inside = q[0] >= 0 && q[1] >= 0 && q[0] <= right && q[1] <= bottom;
            const double error = cv::norm(forward.at<cv::Vec2f>(y, x) + back.at<cv::Vec2f>(y, x));
            out.at<float>(y, x) =
                inside ? static_cast<float>(1 - std::min(error / alpha, 1.0)) : 0.0F;
        }
    return out;
}

PaperPipeline::PaperPipeline(const StereoRig& rig, Size output, const PaperOptions& options)
    : rig_(rig), options_(options), videoMap_(stillMap(rig, rig.video.size)),
      outputMap_(stillMap(rig, output)), dis_(createDis(options.flow)) {}

void PaperPipeline::setStill(const cv::Mat& still) {
    still_ = still;
    cv::cvtColor(resampleStill(still, rig_), stillGrey_, cv::COLOR_BGR2GRAY);
}

const cv::Mat& PaperPipeline::run(const cv::Mat& video) {
    cv::cvtColor(video, grey_, cv::COLOR_BGR2GRAY);
    // DIS would use an existing flow as its first guess. Every frame must start without a guess.
    forward_.release();
    backward_.release();
    dis_->calc(grey_, stillGrey_, forward_);
    dis_->calc(stillGrey_, grey_, backward_);
    confidence_ = twoWayConfidence(forward_, backward_, options_.alpha);

    cv::resize(stillShift(videoMap_, forward_), shift_, outputMap_.size(), 0, 0, cv::INTER_LINEAR);
    shift_ += outputMap_;
    cv::remap(still_, warped_, shift_, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);

    cv::Mat weight;
    confidence_.convertTo(weight, CV_8U, 255);
    cv::resize(weight, weight_, outputMap_.size(), 0, 0, cv::INTER_LINEAR);
    cv::resize(video, enlarged_, outputMap_.size(), 0, 0, cv::INTER_CUBIC);
    blendInto(enlarged_, warped_, weight_);
    return enlarged_;
}

}  // namespace mfar::eval
