#include "tests/measure/eval/superres_methods.h"

#include "tests/measure/eval/dnn_peer.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/pipeline_shot.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/stopwatch.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <functional>
#include <stdexcept>

namespace mfar::eval {
namespace {

class PipelineMethod final : public SuperResMethod {
public:
    PipelineMethod(const StereoRig& rig, SuperResMode mode, bool usePoses,
                   std::shared_ptr<const FilterBank> filters)
        : usePoses_(usePoses),
          pipeline_(rig, {.mode = mode, .output = {}, .skipUnchanged = false}) {
        pipeline_.setFilters(std::move(filters));
    }

    void setStills(const Shot& newest, const Shot* second) override {
        pipeline_.dropStill();
        if (second != nullptr) PipelineShot(*second, usePoses_).giveAsStill(pipeline_);
        PipelineShot(newest, usePoses_).giveAsStill(pipeline_);
    }

    Result run(const Shot& frame) override {
        const PipelineShot shot(frame, usePoses_);
        shot.run(pipeline_);
        // Reads the picture before the second run, which is timed, because the second run could
        // start from the first run's result.
        Result out{fromRgba(pipeline_.readImage(), pipeline_.outputSize()), 0};
        glFinish();
        out.ms = wallMs([&] {
            shot.run(pipeline_);
            glFinish();
        });
        return out;
    }

private:
    bool usePoses_;
    Pipeline pipeline_;
};

class Enlarging final : public SuperResMethod {
public:
    using Enlarge = std::function<cv::Mat(const cv::Mat& video)>;
    explicit Enlarging(Enlarge enlarge) : enlarge_(std::move(enlarge)) {}

    void setStills(const Shot&, const Shot*) override {}

    Result run(const Shot& frame) override {
        Result out{enlarge_(frame.picture), 0};
        out.ms = wallMs([&] { (void)enlarge_(frame.picture); });
        return out;
    }

private:
    Enlarge enlarge_;
};

std::unique_ptr<SuperResMethod> enlargement(Size output, int filter) {
    const cv::Size size(output.width, output.height);
    return std::make_unique<Enlarging>(
        [size, filter, out = cv::Mat()](const cv::Mat& video) mutable {
            cv::resize(video, out, size, 0, 0, filter);
            return out;
        });
}

class PaperMethod final : public SuperResMethod {
public:
    PaperMethod(const StereoRig& rig, double alpha)
        : paper_(rig, outputSize(rig), {DisPreset::Medium, alpha}) {}

    void setStills(const Shot& newest, const Shot*) override { paper_.setStill(newest.picture); }

    Result run(const Shot& frame) override {
        Result out{paper_.run(frame.picture).clone(), 0};
        out.ms = wallMs([&] { paper_.run(frame.picture); });
        return out;
    }

private:
    PaperPipeline paper_;
};

class PipelineMatcher final : public StillMatcher {
public:
    explicit PipelineMatcher(const StereoRig& rig)
        : video_(rig.video.size.width, rig.video.size.height),
          pipeline_(rig, {.output = {}, .skipUnchanged = false}) {}

    void setStill(const Shot& still) override { PipelineShot(still).giveAsStill(pipeline_); }

    StillMatch run(const Shot& frame) override {
        PipelineShot(frame).run(pipeline_);
        const std::vector<float> flow = pipeline_.readFlow();
        const std::vector<float> confidence = pipeline_.readConfidence();
        return {cv::Mat(flow, true).reshape(2, video_.height),
                cv::Mat(confidence, true).reshape(1, video_.height)};
    }

private:
    cv::Size video_;
    Pipeline pipeline_;
};

}  // namespace

const std::vector<std::string>& superResMethodNames() {
    static const std::vector<std::string> names{"detail",  "detail2d", "blend", "bilinear",
                                                "bicubic", "lanczos",  "paper"};
    return names;
}

bool needsStill(const std::string& method) {
    return method == "detail2d" || method == "blend" || method == "paper";
}

std::unique_ptr<SuperResMethod> SuperResFactory::create(const std::string& name,
                                                        const StereoRig& rig) {
    if (name == "bicubic") return enlargement(outputSize(rig), cv::INTER_CUBIC);
    if (name == "bilinear") return enlargement(outputSize(rig), cv::INTER_LINEAR);
    if (name == "lanczos") return enlargement(outputSize(rig), cv::INTER_LANCZOS4);
    if (name == "paper") return std::make_unique<PaperMethod>(rig, alpha_);
    const bool blend = name == "blend";
    if (!blend && name != "detail" && name != "detail2d")
        throw std::invalid_argument(fmt::format("unknown method '{}'", name));
    requireContext();
    return std::make_unique<PipelineMethod>(rig, blend ? SuperResMode::Blend : SuperResMode::Detail,
                                            name != "detail2d", filters_);
}

std::unique_ptr<SuperResMethod> SuperResFactory::createModel(const std::filesystem::path& file,
                                                             const StereoRig& rig) {
    return std::make_unique<Enlarging>(dnnEnlarger(file, outputSize(rig)));
}

std::unique_ptr<StillMatcher> SuperResFactory::createMatcher(const StereoRig& rig) {
    requireContext();
    return std::make_unique<PipelineMatcher>(rig);
}

void SuperResFactory::requireContext() {
    if (!context_) context_ = createGlContext();
}

}  // namespace mfar::eval
