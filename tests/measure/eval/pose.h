#pragma once

#include "pipeline/track/tracker.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct PoseRequest {
    /// Recordings with poses and tags.toml, or folders with pictures NAME.jpg|png and the corners
    /// of their tags in NAME.txt.
    std::vector<std::filesystem::path> folders;
    std::vector<std::string> methods;  ///< of poseMethodNames(), for recordings
    int frames = 0;                    ///< per folder, 0 = all
    TrackerOptions tracker;            ///< the map is replaced by each recording's
};

/// Ours: the filter's pose and the last frame's tags alone, of every video frame, and of every
/// still the pose it shows itself.
[[nodiscard]] const std::vector<std::string>& poseMethodNames();

/// Columns as in design.md, section 10, and more; those that mean nothing for a folder stay empty.
/// At the end the means, and per recording and method the medians with the number of flips.
/// Throws EvalError, RecordingError, TagMapError and ImageFileError.
[[nodiscard]] Report evaluatePose(const PoseRequest& request);

}  // namespace mfar::eval
