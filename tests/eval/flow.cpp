#include "tests/eval/flow.h"

#include "tests/eval/flow_methods.h"
#include "tests/eval/flow_samples.h"
#include "tests/eval/labels.h"
#include "tests/eval/metrics/flow_error.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace mfar::eval {
namespace {

namespace fs = std::filesystem;

/// The poses of samples, which those of recordings may get from somewhere else.
void setPoses(std::vector<FlowSample>& samples, const fs::path& folder, PoseSource source) {
    if (source == PoseSource::Recorded) return;
    if (!fs::exists(folder / "cam0")) {
        if (source == PoseSource::Tags)
            throw EvalError(fmt::format("{}: no recording, so no tags are known", folder.string()));
        return;  // a pair has none
    }
    const Recording recording = loadRecording(folder);
    const KnownPoses poses(recording, source);
    for (FlowSample& sample : samples)
        sample.given = poses.of(sample.videoTime, sample.stillTime);
}

/// One folder with the methods set up for its rig.
class FolderRun {
public:
    FolderRun(const FlowRequest& request, const fs::path& folder, std::string label,
              FlowFactory& factory)
        : request_(request), set_(flowSamplesOf(folder)), label_(std::move(label)) {
        setPoses(set_.samples, folder, request.poses);
        for (const std::string& name : request.methods)
            methods_.push_back(factory.create(name, set_.rig));
        if (request.frames > 0 && set_.samples.size() > static_cast<std::size_t>(request.frames))
            set_.samples.resize(static_cast<std::size_t>(request.frames));
    }

    void measure(Report& report) {
        for (const FlowSample& sample : set_.samples)
            measure(sample, report);
    }

private:
    void measure(const FlowSample& sample, Report& report) {
        const cv::Mat truth = loadTruth(set_, sample);
        Shot frame = loadFrame(set_, sample);
        if (frame.pose) frame.pose = turned(*frame.pose, request_.poseNoise, label_);
        setStill(sample);
        for (std::size_t i = 0; i < methods_.size(); ++i) {
            const auto result = methods_[i]->run(frame);
            const FlowError error = flowError(result.flow, truth);
            if (error.known == 0)
                throw EvalError(fmt::format("{}: no vector is known", sample.truth.string()));
            // A method that had no answer was not at work either.
            const bool answered = error.coverage > 0;
            report.add(label_, sample.frame, request_.methods[i],
                       {answered ? std::optional(result.ms) : std::nullopt,
                        answered ? std::optional(error.epe) : std::nullopt, error.bad1, error.bad2,
                        error.coverage});
        }
    }

    void setStill(const FlowSample& sample) {
        if (still_ == sample.still) return;
        Shot still = loadStill(set_, sample);
        still.picture =
            degrade(still.picture, request_.degradation, static_cast<std::uint64_t>(still.time.ns));
        for (const auto& method : methods_)
            method->setStill(still);
        still_ = sample.still;
    }

    const FlowRequest& request_;
    FlowSet set_;
    std::string label_;
    std::vector<std::unique_ptr<FlowMethod>> methods_;
    fs::path still_;
};

}  // namespace

Report evaluateFlow(const FlowRequest& request) {
    Report report({{"ms", 1}, {"epe_px", 3}, {"bad1", 4}, {"bad2", 4}, {"coverage", 4}});
    FlowFactory factory;
    const auto labels = labelsOf(request.folders);
    for (std::size_t i = 0; i < labels.size(); ++i)
        FolderRun(request, request.folders[i], labels[i], factory).measure(report);
    report.addMeans();
    return report;
}

}  // namespace mfar::eval
