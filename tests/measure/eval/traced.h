#pragma once

#include "base/geometry.h"
#include "base/progress.h"
#include "hal/virtual/synthetic_scene.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct TracedRequest {
    std::vector<std::string> scenes;     ///< of warpSceneNames(), or files of glTF
    std::vector<synthetic::Path> paths;  ///< of the synthetic board's camera
    std::vector<std::string> methods;    ///< of tracedMethodNames()
    Size size{640, 480};                 ///< of the layer
    double budgetMs = 8;                 ///< processor time of the path tracer per frame
    int frames = 90;                     ///< per path, at 30 per second
    int every = 10;                      ///< frames per period, of which one and the next are
                                         ///< compared
    int truthSamples = 256;              ///< per pixel of the truth
    std::filesystem::path truth;         ///< folder in which the truth is kept; empty: traced again
    std::filesystem::path save;          ///< folder for compared frames and truth; empty: not saved
    std::filesystem::path video;         ///< folder for a y4m of each path; empty: not written
    ProgressPart progress{};             ///< what is shown while it runs
};

[[nodiscard]] std::vector<std::string> tracedMethodNames();

/// Measures how the product shows path-traced objects while the camera moves: the layer of every
/// frame, made within the budget, is compared with a picture path traced for the same view, both
/// over grey paper. Rows of SCENE/PATH, frame and method; means over the frames after the first
/// half second. Columns [dB]: psnr of the pixels where the truth shows an object, shadow_psnr where
/// it shows a change of the real surface; flicker of the objects' luma [grey levels], see
/// metrics/flicker.h; pictures shown so far; warp_ms. Needs a current GL context if the engine is
/// GLES. Throws EvalError.
[[nodiscard]] Report evaluateTraced(const TracedRequest& request);

}  // namespace mfar::eval
