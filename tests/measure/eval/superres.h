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
    std::vector<std::string> methods;              ///< of superResMethodNames()
    std::vector<std::filesystem::path> dnnModels;  ///< further peers, named like their files
    bool classes = false;                          ///< measure each method's gain per
                                                   ///< matchClasses()
    bool noStill = false;                          ///< enlarge the video without a still
    int stills = 1;                                ///< 2: also use the second-nearest still in time
    Degradation degradation;                       ///< applied to every still
    Degradation videoDegradation;                  ///< applied to every frame of the video
    int learn = 0;  ///< matched stills from which filters are learned before; 0: default filters
    /// Recordings to learn from; empty: each recording learns from itself.
    std::vector<std::filesystem::path> learnFrom;
    PoseSource poses = PoseSource::Recorded;
    PoseNoise poseNoise;         ///< of every frame
    double alpha = 2;            ///< of the paper's confidence [video px]
    int frames = 0;              ///< per recording, 0 = all that have truth
    std::filesystem::path save;  ///< folder for the pictures; empty: not saved
    PictureMetrics metrics{{"psnr", "ssim"}, {}};
    ProgressPart progress{};  ///< what is shown while it runs
};

/// Measures every method on every frame with truth/highres. Prints one line per skipped frame to
/// stderr. Throws EvalError and RecordingError.
[[nodiscard]] Report evaluateSuperRes(const SuperResRequest& request);

}  // namespace mfar::eval
