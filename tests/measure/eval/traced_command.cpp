#include "tests/measure/eval/traced_command.h"

#include "hal/gl_context.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/picture_options.h"
#include "tests/measure/eval/warp_scenes.h"

namespace mfar::eval {
namespace {

constexpr const char* kTracedHelp =
    "Moves the camera as the synthetic board does, path traces the objects within the budget of\n"
    "each frame as mfard does, and compares what is shown with a picture traced in that view.\n"
    "Methods: product; independent: the same budget and filter, random numbers without order and\n"
    "no light kept from one picture to the next.\n"
    "psnr_db: of red, green and blue where the truth shows an object; shadow_psnr_db: where it\n"
    "shows a shadow or light of the objects on the real surface; flicker [grey levels]: change\n"
    "of the luma error of objects from a frame to the next along their motion, root mean square\n"
    "over the square root of two; pictures: shown so far; warp_ms: drawing of the layer. Frames\n"
    "of the first half second are not scored.";

}  // namespace

CLI::App* addTracedCommand(CLI::App& app, TracedRequest& request) {
    CLI::App* sub = app.add_subcommand("traced", "virtual objects while the camera moves");
    sub->footer(kTracedHelp);
    request.scenes = warpSceneNames();
    request.paths = {synthetic::Path::Handheld, synthetic::Path::Orbit, synthetic::Path::Forward};
    request.methods = tracedMethodNames();
    sub->add_option("--scenes", request.scenes,
                    fmt::format("of {}, or files of glTF", fmt::join(warpSceneNames(), ", ")))
        ->delimiter(',');
    addNames(*sub, "--paths", request.paths, "of the camera (default: handheld,orbit,forward)",
             synthetic::pathNamed);
    sub->add_option("--methods", request.methods,
                    fmt::format("of {}", fmt::join(tracedMethodNames(), ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(tracedMethodNames()));
    addSize(*sub, request.size, "layer");
    sub->add_option("--budget", request.budgetMs, "processor time of the path tracer a frame [ms]")
        ->check(isBudget)
        ->capture_default_str();
    sub->add_option("--frames", request.frames, "of each path, 30 a second")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_option("--every", request.every, "so many frames, one and the next are compared")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    sub->add_option("--truth-samples", request.truthSamples, "a pixel of the truth")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--truth", request.truth, "folder that keeps the truth from run to run");
    sub->add_option("--save", request.save, "folder for the compared frames and their truth");
    sub->add_option("--video", request.video,
                    "folder for a y4m of each path, methods side by side");
    return sub;
}

Report runTracedCommand(const TracedRequest& request) {
    // Uses the engine that the environment variable MFAR_ENGINE names.
    const bool gles = EngineChoice::fromEnvironment().occlusion == EngineKind::Gles;
    const auto context = gles ? createGlContext() : nullptr;
    return evaluateTraced(request);
}

}  // namespace mfar::eval
