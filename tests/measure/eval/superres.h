#pragma once

#include "base/progress.h"
#include "tests/measure/eval/degrade.h"
#include "tests/measure/eval/picture_metrics.h"
#include "tests/measure/eval/pose_source.h"
#include "tests/measure/eval/report.h"
#include "tests/measure/eval/shot.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct SuperResRequest {
    std::vector<std::filesystem::path> recordings;
    std::vector<std::string> methods;
    std::vector<std::filesystem::path> dnnModels;
    bool classes = false;
    bool noStill = false;
    int stills = 1;           ///< 1: reference only; 2: secondStill() too
    Degradation degradation;  ///< applied to every still
    Degradation videoDegradation;
    /// Number of matched stills to learn from, or kEachOnce; 0: shipped filters.
    int learn = 0;
    /// Recordings to learn from. Empty: each recording learns from its own stills.
    std::vector<std::filesystem::path> learnFrom;
    PoseSource poses = PoseSource::Recorded;
    PoseNoise poseNoise;
    double alpha = 2;            ///< see PaperOptions::alpha
    int frames = 0;              ///< largest number of frames per recording; 0: all with truth
    std::filesystem::path save;  ///< folder for the pictures; empty: not saved
    PictureMetrics metrics{{"psnr", "ssim"}, {}};
    ProgressPart progress{};
};

/// Measures every method on every frame with truth/highres. Prints a line per skipped frame to
/// stderr. Throws EvalError, RecordingError, TagMapError and ImageFileError.
[[nodiscard]] Report evaluateSuperRes(const SuperResRequest& request);

}  // namespace mfar::eval
