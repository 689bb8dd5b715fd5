#include "tests/measure/eval/sample_run.h"

#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <utility>

namespace mfar::eval {
namespace {

namespace fs = std::filesystem;

void setPoses(std::vector<FlowSample>& samples, const fs::path& folder, PoseSource source) {
    if (source == PoseSource::Recorded) return;
    if (!fs::exists(folder / "cam0")) {
        if (source == PoseSource::Tags)
            throw EvalError(
                fmt::format("{}: --poses tags needs a recording, but this folder has no cam0",
                            folder.string()));
        return;
    }
    const Recording recording = loadRecording(folder);
    const KnownPoses poses(recording, source);
    for (FlowSample& sample : samples)
        sample.given = poses.of(sample.videoTime, sample.stillTime);
}

}  // namespace

SampleRun::SampleRun(const SampleRequest& request, const fs::path& folder, std::string label,
                     FlowSet set)
    : request_(request), set_(std::move(set)), label_(std::move(label)) {
    setPoses(set_.samples, folder, request.poses);
    if (request.frames > 0 && set_.samples.size() > static_cast<std::size_t>(request.frames))
        set_.samples.resize(static_cast<std::size_t>(request.frames));
}

void SampleRun::each(const std::function<void(const Shot&)>& still,
                     const std::function<void(const FlowSample&, const Shot&)>& frame) const {
    fs::path reference;
    for (const FlowSample& sample : set_.samples) {
        Shot shot = loadFrame(set_, sample);
        if (shot.pose) shot.pose = turned(*shot.pose, request_.poseNoise, label_);
        if (reference != sample.still) {
            Shot next = loadStill(set_, sample);
            next.picture = degrade(next.picture, request_.degradation,
                                   static_cast<std::uint64_t>(next.time.ns));
            still(next);
            reference = sample.still;
        }
        frame(sample, shot);
    }
}

}  // namespace mfar::eval
