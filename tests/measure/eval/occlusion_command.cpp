#include "tests/measure/eval/occlusion_command.h"

#include "daemon/number_range.h"
#include "daemon/output_checks.h"
#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/pose_source_option.h"

namespace mfar::eval {
namespace {

constexpr const char* kOcclusionHelp =
    "Shows each virtual object alone in synthetic scenes. Compares the pixels in which it is\n"
    "visible with the truth at the centre of every video pixel. `recorded` poses are the exact\n"
    "poses of the synthetic board.\n"
    "iou: intersection over union of the visible and the truly visible pixels; boundary_px:\n"
    "mean distance of the object's boundary from the true one [video px]; flicker (only for\n"
    "path `rest`): share of all pixels of the object, occluded ones included, that are shown in\n"
    "only one of two consecutive frames, at the output's resolution; depth_ms, composite_ms:\n"
    "times of the two stages that find depth and that draw the object. A frame in which\n"
    "nothing changed needs neither stage.\n"
    "The first 8 frames are not scored; the still is requested in the first of them.";

}  // namespace

CLI::App* addOcclusionCommand(CLI::App& app, OcclusionRequest& request, std::string& csv) {
    CLI::App* sub = app.add_subcommand(
        "occlusion",
        "measure how accurately real things in synthetic scenes occlude virtual objects");
    sub->footer(kOcclusionHelp);
    addNames(*sub, "--scenes", request.scenes,
             "synthetic scenes of mfar-sim (default: office,shelf)", synthetic::sceneNamed);
    addNames(*sub, "--paths", request.paths, "paths of the camera (default: handheld,rest)",
             synthetic::pathNamed);
    sub->add_option("--objects", request.objects,
                    "configuration file of mfard whose [[objects]] are shown one after the other "
                    "(default, for office and shelf: a sphere, half hidden behind real things)");
    addPoseSource(*sub, request.poses);
    sub->add_option("--frames", request.frames, "number of scored frames on each path")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
    sub->add_option("--noise", request.noise,
                    "noise of both sensors as a multiple of their usual noise")
        ->check(numberFrom(0, 100))
        ->capture_default_str();
    sub->add_option("--csv", csv, "file to write the table into")->check(fileToWrite());
    return sub;
}

}  // namespace mfar::eval
