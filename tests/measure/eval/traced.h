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
    std::vector<std::string> scenes;  ///< names from warpSceneNames(), or glTF files
    std::vector<synthetic::Path> paths;
    std::vector<std::string> methods;
    Size size{640, 480};
    double budgetMs = 8;  ///< processor time of the path tracer per frame
    int frames = 90;      ///< frames per path, at 30 per second
    /// One of this many frames is compared. Flicker is measured from a compared frame to the frame
    /// after it.
    int every = 10;
    int truthSamples = 256;
    bool hdrVdp = false;
    std::filesystem::path truth;  ///< folder that keeps the truth for later runs; empty: not kept
    std::filesystem::path save;   ///< folder for compared frames and truth; empty: not saved
    std::filesystem::path video;  ///< folder for a Y4M file of each path; empty: not written
    ProgressPart progress{};
};

[[nodiscard]] std::vector<std::string> tracedMethodNames();

/// Measures how mfard shows path-traced objects while the camera moves. In compared frames,
/// the layer that was made within the budget is compared with a picture traced for the same view,
/// both over grey paper. Rows are SCENE/PATH, frame and method. Frames of the first half
/// second are not compared.
///
/// Columns: psnr_db, of pixels where the truth shows an object; shadow_psnr_db, of pixels where the
/// truth shows a shadow or light of an object on the real surface; flicker of the luma error of
/// objects [grey levels], see metrics/flicker.h; pictures, the number of traced pictures shown so
/// far; first_s, the time of the frame in which the first of them became ready; warp_ms, the time
/// of drawing the layer; with `hdrVdp`, hdrvdp_q of the whole frame on the display HdrVdpDisplay{}.
/// The GLES engine needs a current context. Throws EvalError and ImageFileError.
[[nodiscard]] Report evaluateTraced(const TracedRequest& request);

}  // namespace mfar::eval
