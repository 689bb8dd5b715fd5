#pragma once

#include "base/progress.h"
#include "pipeline/track/tracker.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct PoseRequest {
    /// Recordings with poses and tags.toml, or folders with pictures NAME.jpg or NAME.png whose tag
    /// corners are in NAME.txt.
    std::vector<std::filesystem::path> folders;
    std::vector<std::string> methods;  ///< from poseMethodNames(); not used for folders of pictures
    int frames = 0;                    ///< largest number of frames per folder; 0: all
    TrackerOptions tracker;
    ProgressPart progress{};
};

/// Names of mfar's poses. "filtered": pose of a frame after the tracker's filter over time;
/// "raw": pose of a frame from its own tags only; "still": pose of a still from its own tags.
[[nodiscard]] const std::vector<std::string>& poseMethodNames();

/// Columns that do not apply to a folder stay empty. The last rows are the means, then the medians
/// of each recording and method. Only the rows of medians have a value in the column `flips`: the
/// number of frames whose rotation error differs from that of the previous frame by more than 3
/// degrees. Throws EvalError, RecordingError, TagMapError and ImageFileError.
[[nodiscard]] Report evaluatePose(const PoseRequest& request);

}  // namespace mfar::eval
