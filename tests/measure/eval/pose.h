#pragma once

#include "base/progress.h"
#include "pipeline/track/tracker.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct PoseRequest {
    /// Folders are recordings with poses and tags.toml, or hold pictures NAME.jpg or NAME.png with
    /// their tags' corners in NAME.txt.
    std::vector<std::filesystem::path> folders;
    std::vector<std::string> methods;  ///< names out of poseMethodNames(); only for recordings
    int frames = 0;                    ///< number of frames per folder, 0: all
    TrackerOptions tracker;            ///< a recording replaces the tag map by its own
    ProgressPart progress{};           ///< shows the progress while the command runs
};

/// The product's poses. For a video frame: the pose of the filter, and the pose from the tags of
/// that frame alone. For a still: the pose from the still itself.
[[nodiscard]] const std::vector<std::string>& poseMethodNames();

/// A column that has no meaning for a folder stays empty. The last rows are the means and, for each
/// recording and method, the medians with the number of flips. Throws EvalError, RecordingError,
/// TagMapError and ImageFileError.
[[nodiscard]] Report evaluatePose(const PoseRequest& request);

}  // namespace mfar::eval
