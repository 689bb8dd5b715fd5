#pragma once

#include "base/geometry.h"
#include "tests/measure/eval/report.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

struct WarpRequest {
    std::vector<double> degrees{0.5, 1, 2, 5, 10, 20};  ///< turns of the view about the scene
    std::vector<std::string> scenes;                    ///< of warpSceneNames(), or files of glTF
    std::vector<std::string> methods;                   ///< of warpMethodNames()
    Size size{640, 480};
    int referenceSamples = 64, truthSamples = 256, holeSamples = 16;
    std::filesystem::path save;  ///< folder for the pictures; empty: none
};

[[nodiscard]] std::vector<std::string> warpMethodNames();

/// A path-traced picture of each scene, warped to views at `degrees` from its own: rows of
/// SCENE/DEGREES, `frame` 0 and means over none. Columns: psnr_db inside the silhouette of the
/// objects, against a picture path traced there with truthSamples; hole_share of the silhouette's
/// pixels; reray_share: rays of what is rendered for itself over those of a full picture, which are
/// referenceSamples of all pixels in the tracer's bounds; reray_of_objects: the same over those of
/// the silhouette's pixels alone; ms of the warp, waited for, or of the peer. Needs a current GL
/// context. Throws EvalError.
[[nodiscard]] Report evaluateWarp(const WarpRequest& request);

/// The report's PSNR over the degrees, as an SVG document.
[[nodiscard]] std::string warpSvg(const WarpRequest& request, const Report& report);

}  // namespace mfar::eval
