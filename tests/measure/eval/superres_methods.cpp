#include "tests/measure/eval/superres_methods.h"

#include "pipeline/pipeline.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/rig_resample.h"
#include "tests/measure/eval/stopwatch.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

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
        if (second != nullptr) setStill(*second);
        setStill(newest);
    }

    Result run(const Shot& frame) override {
        const cv::Mat rgba = toRgba(frame.picture);
        const auto pose = usePoses_ ? frame.pose : std::nullopt;
        pipeline_.run(viewOf(rgba), frame.time, pose);
        // The picture is that of the first run: a second one could start from its own answer.
        Result out{fromRgba(pipeline_.readImage(), pipeline_.outputSize()), 0};
        glFinish();
        out.ms = wallMs([&] {
            pipeline_.run(viewOf(rgba), frame.time, pose);
            glFinish();
        });
        return out;
    }

private:
    void setStill(const Shot& still) {
        const cv::Mat rgba = toRgba(still.picture);
        pipeline_.setStill(viewOf(rgba), still.time, usePoses_ ? still.pose : std::nullopt);
    }

    bool usePoses_;
    Pipeline pipeline_;
};

class Upscaling final : public SuperResMethod {
public:
    /// `filter`: of cv::InterpolationFlags.
    Upscaling(Size output, int filter) : output_(output.width, output.height), filter_(filter) {}

    void setStills(const Shot&, const Shot*) override {}

    Result run(const Shot& frame) override {
        Result out;
        const auto resize = [&] { cv::resize(frame.picture, out.picture, output_, 0, 0, filter_); };
        resize();
        out.ms = wallMs(resize);
        return out;
    }

private:
    cv::Size output_;
    int filter_;
};

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

}  // namespace

const std::vector<std::string>& superResMethodNames() {
    static const std::vector<std::string> names{"detail",   "detail2d", "blend",
                                                "bilinear", "bicubic",  "paper"};
    return names;
}

bool needsStill(const std::string& method) {
    return method == "detail2d" || method == "blend" || method == "paper";
}

std::unique_ptr<SuperResMethod> SuperResFactory::create(const std::string& name,
                                                        const StereoRig& rig) {
    if (name == "bicubic") return std::make_unique<Upscaling>(outputSize(rig), cv::INTER_CUBIC);
    if (name == "bilinear") return std::make_unique<Upscaling>(outputSize(rig), cv::INTER_LINEAR);
    if (name == "paper") return std::make_unique<PaperMethod>(rig, alpha_);
    const bool blend = name == "blend";
    if (!blend && name != "detail" && name != "detail2d")
        throw std::invalid_argument(fmt::format("unknown method '{}'", name));
    if (!context_) context_ = createGlContext();
    return std::make_unique<PipelineMethod>(rig, blend ? SuperResMode::Blend : SuperResMode::Detail,
                                            name != "detail2d", filters_);
}

}  // namespace mfar::eval
