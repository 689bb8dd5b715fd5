#pragma once

#include "base/geometry.h"
#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct WarpRequest {
    std::vector<double> degrees{0.5, 1, 2, 5, 10, 20};  ///< angles by which the view is turned
    std::vector<std::string> scenes;                    ///< warpSceneNames() or glTF files
    std::vector<std::string> methods;                   ///< warpMethodNames()
    Size size{640, 480};
    int referenceSamples = 64, truthSamples = 256, holeSamples = 16;
    std::filesystem::path save;  ///< folder for the pictures; empty: not saved
    ProgressPart progress{};     ///< shows the progress while the command runs
};

[[nodiscard]] std::vector<std::string> warpMethodNames();

/// Warps a path-traced picture of each scene to views that differ by `degrees`, and compares it
/// with a picture path traced there with truthSamples. Rows are SCENE/DEGREES; `frame` is 0; there
/// are no means. Needs a current GL context. Throws EvalError.
///
/// Columns: psnr_db inside the silhouette of the objects; hole_share of the silhouette's pixels;
/// reray_share: rays for individually rendered pixels over those of a full picture
/// (referenceSamples for all pixels in the tracer's bounds); reray_of_objects: the same rays over
/// those of the silhouette's pixels only; ms of the warp until it is complete, or of the peer.
[[nodiscard]] Report evaluateWarp(const WarpRequest& request);

/// PSNR of the report, plotted over the degrees, as an SVG document.
[[nodiscard]] std::string warpSvg(const WarpRequest& request, const Report& report);

}  // namespace mfar::eval
