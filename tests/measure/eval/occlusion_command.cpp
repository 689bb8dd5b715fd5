#include "tests/measure/eval/occlusion_command.h"

#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/pose_source_option.h"

namespace mfar::eval {
namespace {

constexpr const char* kOcclusionHelp =
    "Shows each object alone in synthetic scenes and compares where it is visible with the\n"
    "truth, at the middle of every video pixel. The exact poses of the synthetic board\n"
    "replace recorded ones.\n"
    "iou: intersection over union of the visible pixels and those of the truth; boundary_px:\n"
    "mean distance of the object's boundary from the true one [video px]; flicker, on path\n"
    "rest only: share of the object's pixels, at the output's resolution, hidden or not, that\n"
    "are shown in only one of two consecutive frames; depth_ms, composite_ms: time of these\n"
    "stages, each waited for. A frame in which nothing changed needs neither.\n"
    "The first 8 frames are not scored; the still is requested in the first.";

/// Needed because CLI::Range accepts NaN.
std::string isNoise(const std::string& text) {
    double factor = -1;
    const bool number = CLI::detail::lexical_cast(text, factor);
    return number && factor >= 0 && factor <= 100 ? "" : text + " is not from 0 to 100";
}

}  // namespace

CLI::App* addOcclusionCommand(CLI::App& app, OcclusionRequest& request, std::string& csv) {
    CLI::App* sub = app.add_subcommand(
        "occlusion",
        "compare virtual objects behind real things of synthetic scenes with the truth");
    sub->footer(kOcclusionHelp);
    addNames(*sub, "--scenes", request.scenes,
             "synthetic scenes of mfar-sim (default: office,shelf)", synthetic::sceneNamed);
    addNames(*sub, "--paths", request.paths, "paths of the camera (default: handheld,rest)",
             synthetic::pathNamed);
    sub->add_option("--objects", request.objects,
                    "configuration of mfard whose [[objects]] are shown one after the other "
                    "(default: one object that is half behind real things of office and shelf)");
    addPoseSource(*sub, request.poses);
    sub->add_option("--frames", request.frames, "number of scored frames on each path")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_option("--noise", request.noise,
                    "noise of both sensors as a multiple of their usual noise")
        ->check(isNoise)
        ->capture_default_str();
    sub->add_option("--csv", csv, "file to write the table into");
    return sub;
}

}  // namespace mfar::eval
