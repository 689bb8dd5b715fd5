#pragma once

#include "base/progress.h"
#include "tests/measure/eval/degrade.h"
#include "tests/measure/eval/flow_samples.h"
#include "tests/measure/eval/pose_source.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mfar::eval {

struct SampleRequest {
    std::vector<std::filesystem::path> folders;
    std::vector<std::string> methods;
    Degradation degradation;  ///< applied to every still, or to the second picture of a pair
    PoseSource poses = PoseSource::Recorded;
    PoseNoise poseNoise;
    int frames = 0;  ///< largest number of frames per folder; 0: all frames with truth
    ProgressPart progress{};
};

class SampleRun {
public:
    /// `set`: samples of the folder. `request` must outlive this object. Throws EvalError,
    /// RecordingError, TagMapError and ImageFileError.
    SampleRun(const SampleRequest& request, const std::filesystem::path& folder, std::string label,
              FlowSet set);

    [[nodiscard]] const FlowSet& set() const { return set_; }
    [[nodiscard]] const std::string& label() const { return label_; }

    /// Calls `frame` for every sample in the order of their times. Before the first sample, and
    /// whenever the still changes, calls `still`. Throws EvalError and ImageFileError.
    void each(const std::function<void(const Shot&)>& still,
              const std::function<void(const FlowSample&, const Shot&)>& frame) const;

private:
    const SampleRequest& request_;
    FlowSet set_;
    std::string label_;
};

}  // namespace mfar::eval
