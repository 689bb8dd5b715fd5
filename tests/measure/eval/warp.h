#pragma once

#include "base/geometry.h"
#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct WarpRequest {
    std::vector<double> degrees{0.5, 1, 2, 5, 10, 20};  ///< angles of the view about the scene
    std::vector<std::string> scenes;                    ///< of warpSceneNames(), or files of glTF
    std::vector<std::string> methods;                   ///< of warpMethodNames()
    Size size{640, 480};
    int referenceSamples = 64, truthSamples = 256, holeSamples = 16;
    std::filesystem::path save;  ///< folder for the pictures; empty: not saved
    ProgressPart progress{};     ///< what is shown while it runs
};

[[nodiscard]] std::vector<std::string> warpMethodNames();

/// Warps a path-traced picture of each scene to views at `degrees` from its own: rows of
/// SCENE/DEGREES, `frame` 0, no means. Columns: psnr_db inside the silhouette of the objects,
/// against a picture path traced there with truthSamples; hole_share of the silhouette's pixels;
/// reray_share: rays for individually rendered pixels over those of a full picture
/// (referenceSamples for all pixels in the tracer's bounds); reray_of_objects: the same over those
/// of the silhouette's pixels only; ms of the warp, including its completion, or of the peer. Needs
/// a current GL context. Throws EvalError.
[[nodiscard]] Report evaluateWarp(const WarpRequest& request);

/// PSNR of the report over the degrees, as an SVG document.
[[nodiscard]] std::string warpSvg(const WarpRequest& request, const Report& report);

}  // namespace mfar::eval
