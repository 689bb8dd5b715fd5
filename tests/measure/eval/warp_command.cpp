#include "tests/measure/eval/warp_command.h"

#include "daemon/output_checks.h"
#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/eval/picture_options.h"
#include "tests/measure/eval/warp_scenes.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kWarpHelp =
    "Path-traces a picture of each scene, turns the camera around the objects, warps the\n"
    "picture to the new view, and compares it with a picture that is path-traced in that view.\n"
    "Methods differ in how they fill holes: pixels of the new view that the first picture does\n"
    "not show.\n"
    "none: left empty; push-pull: from pixels around them; re-render: these pixels are traced;\n"
    "both: re-render, and push-pull until the traced pixels arrive; inpaint: by Telea's method\n"
    "in OpenCV; full: no warp, the whole picture is traced anew. re-render and both fill holes\n"
    "in shadows as push-pull does.\n"
    "psnr_db: of red, green and blue where the truth shows an object; hole_share: holes in\n"
    "objects, divided by the pixels of the objects; reray_share: rays of pixels that are\n"
    "traced one by one (holes and blurred edges), divided by the rays of the method `full`;\n"
    "reray_of_objects: the same rays, divided by those of the objects' pixels only;\n"
    "ms: time of the warp after all traced pixels have arrived; for `inpaint`, time of the\n"
    "inpainting only; for `full`, time of the tracing.";

std::string isTurn(const std::string& text) {
    double degrees = -1;
    const bool number = CLI::detail::lexical_cast(text, degrees);
    return number && degrees > 0 && degrees <= 180
               ? ""
               : text + " is not an angle above 0 and up to 180 degrees";
}

}  // namespace

CLI::App* addWarpCommand(CLI::App& app, WarpRequest& request, WarpFiles& files) {
    CLI::App* sub = app.add_subcommand(
        "warp", "compare a path-traced picture that is warped to another view with the truth");
    sub->footer(kWarpHelp);
    request.scenes = warpSceneNames();
    request.methods = warpMethodNames();
    sub->add_option(
           "--scenes", request.scenes,
           fmt::format("scenes: any of {}, or glTF files", fmt::join(warpSceneNames(), ", ")))
        ->delimiter(',');
    sub->add_option(
           "--methods", request.methods,
           fmt::format("methods to measure: any of {}", fmt::join(warpMethodNames(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(warpMethodNames()));
    sub->add_option("--degrees", request.degrees, "angles by which the view is turned [degrees]")
        ->delimiter(',')
        ->check(isTurn)
        ->capture_default_str();
    addSize(*sub, request.size, "picture");
    sub->add_option("--samples", request.referenceSamples,
                    "samples per pixel of the picture that is warped")
        ->check(CLI::Range(1, 65536));
    sub->add_option("--truth-samples", request.truthSamples, "samples per pixel of the truth")
        ->check(CLI::Range(1, 65536));
    sub->add_option("--hole-samples", request.holeSamples,
                    "samples of each pixel that is traced to fill a hole")
        ->check(CLI::Range(1, 256));
    sub->add_option("--save", request.save,
                    "folder to write the pictures of every method and of the truth into");
    sub->add_option("--svg", files.svg, "file to write a plot of the PSNR over the angle into")
        ->check(fileToWrite());
    return sub;
}

Report runWarpCommand(const WarpRequest& request, const WarpFiles& files) {
    // The environment variable MFAR_ENGINE names the engine.
    const bool gles = EngineChoice::fromEnvironment().occlusion == EngineKind::Gles;
    const auto context = gles ? createGlContext() : nullptr;
    Report report = evaluateWarp(request);
    if (!files.svg.empty()) writeText(files.svg, warpSvg(request, report));
    return report;
}

}  // namespace mfar::eval
