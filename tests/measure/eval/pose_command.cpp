#include "tests/measure/eval/pose_command.h"

#include "daemon/output_checks.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kPoseHelp =
    "A folder holds a recording with poses and tags.toml, or pictures NAME.jpg|png, each with the "
    "corners of its tags in NAME.txt. If mfard made the recording with pose = \"tags\", its poses "
    "are mfard's own and not the true ones; mfar-sim records true poses.\n"
    "Columns for recordings: rot_deg, trans_mm: error of the camera's pose against the recorded "
    "pose; trans_percent: trans_mm in percent of the mean distance to the visible tags; "
    "jitter_deg, jitter_mm: change of the error since the previous frame; tags: number of tags "
    "from which the pose was found; ms: time to search tags in the frame and to find its pose; "
    "missed: 1 if the frame has no pose; flips, only in rows `median`: number of frames whose "
    "rotation error differs from that of the previous frame by more than 3 degrees.\n"
    "Columns for pictures: corner_px: root mean square distance of found corners from the given "
    "ones; found, missed, false: numbers of tags that were found, missed, and found by mistake.";

}  // namespace

CLI::App* addPoseCommand(CLI::App& app, PoseRequest& request, std::string& csv) {
    CLI::App* sub =
        app.add_subcommand("pose", "compare camera poses and tag corners with the true ones");
    sub->footer(kPoseHelp);
    request.methods = poseMethodNames();
    sub->add_option("folder", request.folders, "folders of recordings or of pictures")->required();
    sub->add_option(
           "--methods", request.methods,
           fmt::format("methods to measure: any of {}", fmt::join(poseMethodNames(), ", ")))
        ->delimiter(',');
    sub->add_option("--frames", request.frames, "measure at most this many frames of each folder")
        ->check(CLI::Range(1, 1000000));
    TrackerOptions& tracker = request.tracker;
    sub->add_option("--decimation", tracker.decimation,
                    "factor by which the picture is reduced before tags are searched")
        ->capture_default_str();
    sub->add_option("--threads", tracker.threads, "number of threads of libapriltag")
        ->capture_default_str();
    sub->add_option("--full-search-interval", tracker.fullSearchInterval,
                    "number of frames between searches of the whole picture")
        ->capture_default_str();
    sub->add_option("--gamma", tracker.gamma,
                    "gamma of the video sensor, used when corners are refined")
        ->capture_default_str();
    sub->add_option("--still-gamma", tracker.stillGamma,
                    "gamma of the still sensor, used when corners are refined")
        ->capture_default_str();
    sub->add_option("--csv", csv, "file to write the table into")->check(fileToWrite());
    return sub;
}

}  // namespace mfar::eval
