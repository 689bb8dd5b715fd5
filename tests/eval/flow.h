#pragma once

#include "tests/eval/degrade.h"
#include "tests/eval/pose_source.h"
#include "tests/eval/report.h"
#include "tests/eval/shot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct FlowRequest {
    std::vector<std::filesystem::path> folders;  ///< recordings or two-frame pairs
    std::vector<std::string> methods;            ///< of flowMethodNames()
    Degradation degradation;                     ///< done to every still or second picture
    PoseSource poses = PoseSource::Recorded;
    PoseNoise poseNoise;  ///< of every frame
    int frames = 0;       ///< per folder, 0 = all that have truth
};

/// Measures every method on every sample of flowSamplesOf(); columns as in design.md, section 10.
/// Throws EvalError and RecordingError.
[[nodiscard]] Report evaluateFlow(const FlowRequest& request);

}  // namespace mfar::eval
