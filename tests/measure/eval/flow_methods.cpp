#include "tests/measure/eval/flow_methods.h"

#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/pipeline_shot.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/shift_flow.h"
#include "tests/measure/eval/stage_share.h"
#include "tests/measure/eval/stereo_peer.h"
#include "tests/measure/eval/stopwatch.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace mfar::eval {
namespace {

cv::Mat grey(const cv::Mat& picture) {
    cv::Mat out;
    cv::cvtColor(picture, out, cv::COLOR_BGR2GRAY);
    return out;
}

/// Flow between two grey pictures of the same size, computed without knowledge of the cameras.
struct PlainFlows {
    cv::Mat flow, back;
};
using PlainFlow = std::function<PlainFlows(const cv::Mat& a, const cv::Mat& b)>;

constexpr double kAlpha = 2;  // see PaperOptions::alpha

class PlainMethod final : public FlowMethod {
public:
    PlainMethod(const StereoRig& rig, PlainFlow flow) : rig_(rig), flow_(std::move(flow)) {}

    void setStill(const Shot& still) override { still_ = grey(resampleStill(still.picture, rig_)); }

    Result run(const Shot& frame) override {
        const cv::Mat video = grey(frame.picture);
        const PlainFlows found = flow_(video, still_);
        Result out{found.flow, 0};
        if (!found.back.empty()) out.confidence = twoWayConfidence(found.flow, found.back, kAlpha);
        out.ms = medianOfThree([&] { return methodMs([&] { (void)flow_(video, still_); }); });
        return out;
    }

private:
    StereoRig rig_;
    PlainFlow flow_;
    cv::Mat still_;
};

PlainFlow dis(DisPreset preset, bool fullResolution, bool bothWays) {
    auto dis = createDis(preset);
    if (fullResolution) dis->setFinestScale(0);
    return [dis, bothWays](const cv::Mat& a, const cv::Mat& b) {
        PlainFlows out;
        dis->calc(a, b, out.flow);
        if (bothWays) dis->calc(b, a, out.back);
        return out;
    };
}

PlainFlows farneback(const cv::Mat& a, const cv::Mat& b) {
    PlainFlows out;
    cv::calcOpticalFlowFarneback(a, b, out.flow, 0.5, 3, 15, 3, 5, 1.2, 0);
    return out;
}

PlainFlow plainFlow(const std::string& name) {
    if (name == "dis-fast") return dis(DisPreset::Fast, false, false);
    if (name == "dis-medium") return dis(DisPreset::Medium, false, false);
    if (name == "dis-medium-both") return dis(DisPreset::Medium, false, true);
    if (name == "dis-medium-full") return dis(DisPreset::Medium, true, false);
    if (name == "farneback") return farneback;
    return {};
}

class StereoMethod final : public FlowMethod {
public:
    StereoMethod(const StereoRig& rig, StereoPeer::Matcher matcher)
        : rig_(rig), peer_(rig, matcher) {}

    void setStill(const Shot& still) override {
        peer_.setStill(still.picture);
        stillPose_ = still.pose;
    }

    Result run(const Shot& frame) override {
        constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
        if (!frame.pose || !stillPose_)
            return {cv::Mat(frame.picture.size(), CV_32FC2, cv::Scalar(kNan, kNan)), 0};
        StereoPeer::Result out =
            peer_.run(frame.picture, stillFromFrame(rig_, *frame.pose, *stillPose_));
        return {out.flow, out.ms};
    }

private:
    StereoRig rig_;
    StereoPeer peer_;
    std::optional<Pose> stillPose_;
};

/// mfar's flow: along epipolar lines if both poses are known, otherwise in two dimensions.
/// The time includes the pyramid and the search. The search along epipolar lines includes its
/// refinement; the search in two dimensions computes both directions of the flow.
class ProductMethod final : public FlowMethod {
public:
    ProductMethod(const StereoRig& rig, bool usePoses)
        : size_(rig.video.size), usePoses_(usePoses), pipeline_(rig, {.mode = SuperResMode::Detail,
                                                                      .output = rig.video.size,
                                                                      .skipUnchanged = false}) {
        pipeline_.setMeasure(true);
    }

    void setStill(const Shot& still) override {
        still_.emplace(still, usePoses_);
        still_->giveAsStill(pipeline_);
    }

    Result run(const Shot& frame) override {
        const PipelineShot shot(frame, usePoses_);
        shot.run(pipeline_);
        std::vector<float> vectors = pipeline_.readFlow();
        Result out{cv::Mat(size_.height, size_.width, CV_32FC2, vectors.data()).clone(), 0};
        std::vector<float> confidence = pipeline_.readConfidence();
        out.confidence = cv::Mat(size_.height, size_.width, CV_32F, confidence.data()).clone();
        out.ms = medianOfThree([&] {
            // Without a new still, the search would start from the flow of the previous run.
            if (still_) still_->giveAsStill(pipeline_);
            const double all = methodMs([&] { shot.run(pipeline_); });
            return all * shareOfStages(pipeline_, kFlowStages);
        });
        return out;
    }

private:
    Size size_;
    bool usePoses_;
    Pipeline pipeline_;
    std::optional<PipelineShot> still_;
};

}  // namespace

const std::vector<std::string>& flowMethodNames() {
    static const std::vector<std::string> names{
        "epipolar",        "flow2d",    "dis-fast", "dis-medium", "dis-medium-both",
        "dis-medium-full", "farneback", "sgbm",     "stereobm",   "shift"};
    return names;
}

GlContext& FlowFactory::context() {
    if (!context_) context_ = createGlContext();
    return *context_;
}

std::unique_ptr<FlowMethod> FlowFactory::create(const std::string& name, const StereoRig& rig) {
    if (PlainFlow plain = plainFlow(name))
        return std::make_unique<PlainMethod>(rig, std::move(plain));
    if (name == "shift") return shiftFlow(rig);
    if (name == "sgbm") return std::make_unique<StereoMethod>(rig, StereoPeer::Matcher::SemiGlobal);
    if (name == "stereobm") return std::make_unique<StereoMethod>(rig, StereoPeer::Matcher::Block);
    if (name != "epipolar" && name != "flow2d")
        throw std::invalid_argument(fmt::format("unknown method '{}'", name));
    (void)context();
    return std::make_unique<ProductMethod>(rig, name == "epipolar");
}

}  // namespace mfar::eval
