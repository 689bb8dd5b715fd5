#include "tests/measure/eval/warp_command.h"

#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/eval/picture_options.h"
#include "tests/measure/eval/warp_scenes.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kWarpHelp =
    "Path traces a picture of each scene, turns the camera about it, and compares what becomes of\n"
    "the picture with one that is path traced there.\n"
    "Methods: none, push-pull, re-render, both: what fills the pixels that the picture does not\n"
    "show; inpaint: Telea's method in OpenCV, in the holes of none; full: the picture is traced\n"
    "anew.\n"
    "psnr_db: of red, green and blue where the truth shows an object; hole_share: such pixels and\n"
    "those of the shadow over those of the objects; reray_share: rays for pixels that are rendered "
    "for\n"
    "themselves over those that full takes, and over those of the objects' pixels alone; ms: of "
    "the warp\n"
    "once all has arrived, of inpaint alone, of tracing.";

std::string isTurn(const std::string& text) {
    double degrees = -1;
    const bool number = CLI::detail::lexical_cast(text, degrees);
    return number && degrees > 0 && degrees <= 180 ? "" : text + " is not in (0, 180]";
}

}  // namespace

CLI::App* addWarpCommand(CLI::App& app, WarpRequest& request, WarpFiles& files) {
    CLI::App* sub = app.add_subcommand("warp", "a path-traced picture, seen from elsewhere");
    sub->footer(kWarpHelp);
    request.scenes = warpSceneNames();
    request.methods = warpMethodNames();
    sub->add_option("--scenes", request.scenes,
                    fmt::format("of {}, or files of glTF", fmt::join(warpSceneNames(), ", ")))
        ->delimiter(',');
    sub->add_option("--methods", request.methods,
                    fmt::format("of {}", fmt::join(warpMethodNames(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(warpMethodNames()));
    sub->add_option("--degrees", request.degrees, "turns of the view")
        ->delimiter(',')
        ->check(isTurn)
        ->capture_default_str();
    addSize(*sub, request.size, "picture");
    sub->add_option("--samples", request.referenceSamples, "a pixel of the picture")
        ->check(CLI::Range(1, 65536));
    sub->add_option("--truth-samples", request.truthSamples, "a pixel of the truth")
        ->check(CLI::Range(1, 65536));
    sub->add_option("--hole-samples", request.holeSamples, "a pixel rendered for itself")
        ->check(CLI::Range(1, 256));
    sub->add_option("--save", request.save, "folder for the pictures of every method and truth");
    sub->add_option("--svg", files.svg, "file for a plot");
    return sub;
}

Report runWarpCommand(const WarpRequest& request, const WarpFiles& files) {
    // The engine that MFAR_ENGINE names.
    const bool gles = EngineChoice::fromEnvironment().occlusion == EngineKind::Gles;
    const auto context = gles ? createGlContext() : nullptr;
    Report report = evaluateWarp(request);
    if (!files.svg.empty()) writeText(files.svg, warpSvg(request, report));
    return report;
}

}  // namespace mfar::eval
