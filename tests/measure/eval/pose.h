#pragma once

#include "base/progress.h"
#include "pipeline/track/tracker.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct PoseRequest {
    /// Recordings with poses and tags.toml, or folders with pictures NAME.jpg|png and their tags'
    /// corners in NAME.txt.
    std::vector<std::filesystem::path> folders;
    std::vector<std::string> methods;  ///< of poseMethodNames(), for recordings
    int frames = 0;                    ///< per folder, 0 = all
    TrackerOptions tracker;            ///< each recording replaces the map by its own
    ProgressPart progress{};           ///< what is shown while it runs
};

/// The product's poses: of every video frame, the filter's pose and the pose from the last frame's
/// tags alone; of every still, the pose from the still itself.
[[nodiscard]] const std::vector<std::string>& poseMethodNames();

/// Columns as in design.md, section 10, and more; those without meaning for a folder stay empty. At
/// the end come the means and, per recording and method, the medians with the number of flips.
/// Throws EvalError, RecordingError, TagMapError and ImageFileError.
[[nodiscard]] Report evaluatePose(const PoseRequest& request);

}  // namespace mfar::eval
