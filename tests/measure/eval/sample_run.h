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

/// Parameters common to all evaluations of frames against stills.
struct SampleRequest {
    std::vector<std::filesystem::path> folders;  ///< recordings or two-frame pairs
    std::vector<std::string> methods;
    Degradation degradation;  ///< applied to every still or second picture
    PoseSource poses = PoseSource::Recorded;
    PoseNoise poseNoise;      ///< of every frame
    int frames = 0;           ///< per folder, 0 = all that have truth
    ProgressPart progress{};  ///< what is shown while it runs
};

/// The samples of one folder, with the poses and pictures that the request asks for.
class SampleRun {
public:
    /// `set`: the folder's samples. `request` must outlive this. Throws EvalError.
    SampleRun(const SampleRequest& request, const std::filesystem::path& folder, std::string label,
              FlowSet set);

    [[nodiscard]] const FlowSet& set() const { return set_; }
    [[nodiscard]] const std::string& label() const { return label_; }

    /// Calls `frame` for every sample in the order of their times, and `still` before it whenever
    /// the still changes. Throws EvalError and ImageFileError.
    void each(const std::function<void(const Shot&)>& still,
              const std::function<void(const FlowSample&, const Shot&)>& frame) const;

private:
    const SampleRequest& request_;
    FlowSet set_;
    std::string label_;
};

}  // namespace mfar::eval
