#include "tests/measure/eval/occlusion_command.h"

#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/pose_source_option.h"

namespace mfar::eval {
namespace {

constexpr const char* kOcclusionHelp =
    "Shows each object alone in synthetic scenes and compares where it is seen with the truth, at\n"
    "the middle of every video pixel; the board's exact poses stand for recorded ones.\n"
    "iou: intersection over union of what is seen of it and what should be; boundary_px: mean\n"
    "distance of its boundary from the true one [video px]; flicker, path rest alone: share of "
    "its\n"
    "pixels, at the output's resolution, hidden or not, that are shown in one of a frame and the\n"
    "one before and not in the other; depth_ms, composite_ms: of these stages, each waited for. A\n"
    "frame in which nothing changed needs neither.\n"
    "The first 8 frames are not scored; the still is asked for in the first.";

/// Needed because CLI::Range accepts NaN.
std::string isNoise(const std::string& text) {
    double factor = -1;
    const bool number = CLI::detail::lexical_cast(text, factor);
    return number && factor >= 0 && factor <= 100 ? "" : text + " is not in [0, 100]";
}

}  // namespace

CLI::App* addOcclusionCommand(CLI::App& app, OcclusionRequest& request, std::string& csv) {
    CLI::App* sub =
        app.add_subcommand("occlusion", "virtual objects behind real things of synthetic scenes");
    sub->footer(kOcclusionHelp);
    addNames(*sub, "--scenes", request.scenes, "of mfar-sim's (default: office,shelf)",
             synthetic::sceneNamed);
    addNames(*sub, "--paths", request.paths, "of the camera (default: handheld,rest)",
             synthetic::pathNamed);
    sub->add_option("--objects", request.objects,
                    "configuration of mfard: its [[objects]], one after the other (default: one "
                    "half behind real things of office and shelf)");
    addPoseSource(*sub, request.poses);
    sub->add_option("--frames", request.frames, "scored, on each path")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_option("--noise", request.noise, "of both sensors, times their usual one")
        ->check(isNoise)
        ->capture_default_str();
    sub->add_option("--csv", csv, "file for the table");
    return sub;
}

}  // namespace mfar::eval
