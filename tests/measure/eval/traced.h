#pragma once

#include "base/geometry.h"
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
    double budgetMs = 8;                 ///< processor time of the path tracer in a frame
    int frames = 90;                     ///< of each path, at 30 a second
    int every = 10;                      ///< so many frames, one and the next are compared
    int truthSamples = 256;              ///< a pixel of the truth
    std::filesystem::path truth;         ///< folder that keeps the truth; empty: traced anew
    std::filesystem::path save;          ///< folder for compared frames and truth; empty: none
    std::filesystem::path video;         ///< folder for a y4m of each path; empty: none
};

[[nodiscard]] std::vector<std::string> tracedMethodNames();

/// What the product shows of path traced objects while the camera moves: the layer of every frame,
/// made within the budget, against a picture path traced in that very view, both over grey paper.
/// Rows of SCENE/PATH, frame and method; means over the frames after the first half second. Columns
/// [dB]: psnr of the pixels where the truth shows an object, shadow_psnr where it shows what the
/// objects change of the real surface; flicker of the objects' luma [grey levels], as of
/// metrics/flicker.h; pictures shown so far; warp_ms. Needs a current GL context where the engine
/// is GLES. Throws EvalError.
[[nodiscard]] Report evaluateTraced(const TracedRequest& request);

}  // namespace mfar::eval
