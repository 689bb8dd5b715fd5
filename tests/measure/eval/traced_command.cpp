#include "tests/measure/eval/traced_command.h"

#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/picture_options.h"
#include "tests/measure/eval/warp_scenes.h"

namespace mfar::eval {
namespace {

constexpr const char* kTracedHelp =
    "Moves the camera as the synthetic board does, path-traces the objects within the budget\n"
    "of each frame as mfard does, and compares what is shown with a picture traced in that\n"
    "view.\n"
    "Methods: product: as in mfard; independent: the same budget and filter, but independent\n"
    "random numbers, and no light kept from one picture to the next.\n"
    "psnr_db: of red, green and blue where the truth shows an object; shadow_psnr_db: where\n"
    "it shows a shadow or light of the objects on the real surface; flicker [grey levels]:\n"
    "change of the luma error of objects from a frame to the next along their motion, root\n"
    "mean square over the square root of two; pictures: number of traced pictures shown so\n"
    "far; first_s: time of the frame in which the first of them became ready; warp_ms: time of\n"
    "drawing the layer; hdrvdp_q: HDR-VDP-2's quality of the whole frame, 100 if it equals the\n"
    "truth. Frames of the first half second are not compared.\n"
    "The figures of product depend on the speed of the processor, so they differ a little from\n"
    "run to run.";

constexpr const char* kTruthHelp =
    "folder that keeps the truth for later runs; if another version of mfar-eval has made its "
    "files, delete them, because the path tracer may have changed";

}  // namespace

CLI::App* addTracedCommand(CLI::App& app, TracedRequest& request) {
    CLI::App* sub = app.add_subcommand(
        "traced", "compare path-traced objects with the truth while the camera moves");
    sub->footer(kTracedHelp);
    request.scenes = warpSceneNames();
    request.paths = {synthetic::Path::Handheld, synthetic::Path::Orbit, synthetic::Path::Forward};
    request.methods = tracedMethodNames();
    sub->add_option(
           "--scenes", request.scenes,
           fmt::format("scenes: any of {}, or glTF files", fmt::join(warpSceneNames(), ", ")))
        ->delimiter(',');
    addNames(*sub, "--paths", request.paths,
             "paths of the camera (default: handheld,orbit,forward)", synthetic::pathNamed);
    sub->add_option(
           "--methods", request.methods,
           fmt::format("methods to measure: any of {}", fmt::join(tracedMethodNames(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(tracedMethodNames()));
    addSize(*sub, request.size, "layer");
    sub->add_option("--budget", request.budgetMs, "path tracer's processor time per frame [ms]")
        ->check(isBudget())
        ->capture_default_str();
    sub->add_option("--frames", request.frames, "frames of each path, at 30 frames per second")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_option("--every", request.every,
                    "compare one of this many frames; flicker is measured from a compared frame "
                    "to the frame after it")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_flag("--hdrvdp", request.hdrVdp, "compute HDR-VDP-2 as well, which takes longer");
    sub->add_option("--truth-samples", request.truthSamples, "samples per pixel of the truth")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--truth", request.truth, kTruthHelp);
    sub->add_option("--save", request.save, "folder for the compared frames and their truth");
    sub->add_option("--video", request.video,
                    "folder to write a Y4M video of each path into, with the methods side by side");
    return sub;
}

Report runTracedCommand(const TracedRequest& request) {
    // The environment variable MFAR_ENGINE names the engine.
    const bool gles = EngineChoice::fromEnvironment().occlusion == EngineKind::Gles;
    const auto context = gles ? createGlContext() : nullptr;
    return evaluateTraced(request);
}

}  // namespace mfar::eval
