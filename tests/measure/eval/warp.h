#pragma once

#include "base/geometry.h"
#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct WarpRequest {
    std::vector<double> degrees{0.5, 1, 2, 5, 10, 20};
    std::vector<std::string> scenes;  ///< names from warpSceneNames(), or glTF files
    std::vector<std::string> methods;
    Size size{640, 480};
    int referenceSamples = 64, truthSamples = 256, holeSamples = 16;
    std::filesystem::path save;  ///< folder for the pictures; empty: not saved
    ProgressPart progress{};
};

[[nodiscard]] std::vector<std::string> warpMethodNames();

/// Warps a path-traced picture of each scene to views that are turned by `degrees`. Compares each
/// warped picture with one that was traced for the same view with truthSamples. Rows are
/// SCENE/DEGREES. The GLES engine needs a current context. Throws EvalError.
///
/// Columns:
/// psnr_db: inside the objects' silhouette.
/// hole_share: number of objects' pixels that have no rendered sample / number of the silhouette's
/// pixels.
/// reray_share: rays for individually rendered pixels / rays of a full picture, which has
/// referenceSamples rays for each pixel in the tracer's bounds.
/// reray_of_objects: rays for individually rendered pixels / rays of a picture of the silhouette's
/// pixels alone, with referenceSamples rays each.
/// ms: time of the complete warp, or of the other method that is compared.
[[nodiscard]] Report evaluateWarp(const WarpRequest& request);

[[nodiscard]] std::string warpSvg(const WarpRequest& request, const Report& report);

}  // namespace mfar::eval
