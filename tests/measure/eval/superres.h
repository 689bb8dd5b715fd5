#pragma once

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
    std::vector<std::filesystem::path> dnnModels;  ///< peers beside them, named as the files
    bool classes = false;                          ///< what each method gains by matchClasses()
    bool noStill = false;                          ///< the video alone is enlarged
    int stills = 1;                                ///< 2: a second one, next in time to the first
    Degradation degradation;                       ///< done to every still
    Degradation videoDegradation;                  ///< done to every frame of the video
    int learn = 0;  ///< matched stills that filters are learned from before; 0: as shipped
    /// Recordings to learn from; empty: each from itself.
    std::vector<std::filesystem::path> learnFrom;
    PoseSource poses = PoseSource::Recorded;
    PoseNoise poseNoise;         ///< of every frame
    double alpha = 2;            ///< of the paper's confidence [video px]
    int frames = 0;              ///< per recording, 0 = all that have truth
    std::filesystem::path save;  ///< folder for the pictures, empty = none
    PictureMetrics metrics{{"psnr", "ssim"}, {}};
};

/// Measures every method on every frame with truth/highres.
/// One line per frame left out goes to stderr. Throws EvalError and RecordingError.
[[nodiscard]] Report evaluateSuperRes(const SuperResRequest& request);

}  // namespace mfar::eval
