#include "tests/measure/eval/depth_methods.h"

#include "tests/measure/eval/pipeline_shot.h"
#include "tests/measure/eval/stage_share.h"
#include "tests/measure/eval/stopwatch.h"
#include "tests/measure/triangulation/triangulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace mfar::eval {
namespace {

/// Depth from flow, triangulated pixel by pixel. The time is that of the flow alone. The still is
/// resampled to the video's lens and orientation, so both views have the lens of the video camera.
class TriangulatedFlow final : public DepthMethod {
public:
    TriangulatedFlow(const StereoRig& rig, std::unique_ptr<FlowMethod> flow,
                     TriangulationMethod method)
        : rig_(rig), flow_(std::move(flow)), method_(method), stage_(rig.video, rig.video) {}

    void setStill(const Shot& still) override {
        flow_->setStill(still);
        stillPose_ = still.pose;
    }

    Result run(const Shot& frame) override {
        FlowMethod::Result found = flow_->run(frame);
        Result out{cv::Mat(frame.picture.size(), CV_32F, cv::Scalar(0)), found.ms};
        if (!frame.pose || !stillPose_) return out;
        const RigidTransform turn{rig_.T_still_video.rotation.conjugate(), {0, 0, 0}};
        const RigidTransform T_b_a = turn * stillFromFrame(rig_, *frame.pose, *stillPose_);
        const std::span<const float> vectors(found.flow.ptr<float>(), 2 * found.flow.total());
        const auto& points = stage_.run(vectors, T_b_a, {.method = method_});
        for (std::size_t i = 0; i < points.size(); ++i)
            out.inverseDepth.ptr<float>()[i] = points[i].inverseDepth;
        return out;
    }

private:
    StereoRig rig_;
    std::unique_ptr<FlowMethod> flow_;
    TriangulationMethod method_;
    Triangulation stage_;
    std::optional<Pose> stillPose_;
};

/// mfar's depth: search along epipolar lines, filtered over the frames. The time includes all
/// stages that depth needs.
class FilteredDepth final : public DepthMethod {
public:
    explicit FilteredDepth(const StereoRig& rig)
        : pipeline_(rig,
                    {.output = rig.video.size, .skipUnchanged = false, .depthEverywhere = true}) {
        pipeline_.setMeasure(true);
    }

    void setStill(const Shot& still) override { PipelineShot(still).giveAsStill(pipeline_); }

    Result run(const Shot& frame) override {
        PipelineShot(frame).run(pipeline_);
        const InverseDepthField& field = pipeline_.inverseDepth();
        Result out{cv::Mat(frame.picture.size(), CV_32F, cv::Scalar(0)), 0};
        for (std::size_t i = 0; i < field.inverseDepth.size(); ++i)
            if (field.isKnown(i)) out.inverseDepth.ptr<float>()[i] = field.inverseDepth[i];
        out.variance = cv::Mat(frame.picture.size(), CV_32F);
        std::copy(field.variance.begin(), field.variance.end(), out.variance.begin<float>());
        out.ms = msOfStages(pipeline_, kDepthStages);
        return out;
    }

private:
    Pipeline pipeline_;
};

}  // namespace

const std::vector<std::string>& depthMethodNames() {
    static const std::vector<std::string> names{"depth", "flow", "midpoint", "sgbm", "stereobm"};
    return names;
}

std::unique_ptr<DepthMethod> DepthFactory::create(const std::string& name, const StereoRig& rig) {
    if (name == "depth") {
        flows_.context().makeCurrent();
        return std::make_unique<FilteredDepth>(rig);
    }
    const bool peer = name == "sgbm" || name == "stereobm";
    if (!peer && name != "flow" && name != "midpoint")
        throw std::invalid_argument(fmt::format("unknown method '{}'", name));
    flows_.context().makeCurrent();
    return std::make_unique<TriangulatedFlow>(rig, flows_.create(peer ? name : "epipolar", rig),
                                              name == "midpoint" ? TriangulationMethod::Midpoint
                                                                 : TriangulationMethod::Flow);
}

}  // namespace mfar::eval
