#include "tests/measure/eval/pose_command.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kPoseHelp =
    "Takes recordings with poses and tags.toml, and folders with NAME.jpg|png and the corners of "
    "the tags in NAME.txt.\n"
    "Recordings: rot_deg, trans_mm: error of the camera's pose against the recorded pose; "
    "trans_percent: trans_mm in percent of the mean distance to the visible tags; jitter: change "
    "of the error since the frame before; ms: time of search and pose of the frame; missed: frames "
    "without a pose; flips, in rows `median`: how often the error turned by more than 3 degrees "
    "from one frame to the next.\n"
    "Pictures: corner_px: root mean square distance to the given corners; found, missed, false: "
    "numbers of tags.";

}  // namespace

CLI::App* addPoseCommand(CLI::App& app, PoseRequest& request, std::string& csv) {
    CLI::App* sub =
        app.add_subcommand("pose", "compare camera poses and tag corners with the true ones");
    sub->footer(kPoseHelp);
    request.methods = poseMethodNames();
    sub->add_option("folder", request.folders, "recordings or folders of pictures")->required();
    sub->add_option("--methods", request.methods,
                    fmt::format("of: {}", fmt::join(poseMethodNames(), ", ")))
        ->delimiter(',');
    sub->add_option("--frames", request.frames, "measure at most this many frames of each folder")
        ->check(CLI::Range(1, 1000000));
    TrackerOptions& tracker = request.tracker;
    sub->add_option("--decimation", tracker.decimation,
                    "decimation of the picture that is searched for quads")
        ->capture_default_str();
    sub->add_option("--threads", tracker.threads, "number of threads of libapriltag")
        ->capture_default_str();
    sub->add_option("--full-search-interval", tracker.fullSearchInterval,
                    "number of frames between searches of the whole picture")
        ->capture_default_str();
    sub->add_option("--gamma", tracker.gamma, "gamma of the video sensor, for the corners")
        ->capture_default_str();
    sub->add_option("--still-gamma", tracker.stillGamma,
                    "gamma of the still sensor, for the corners")
        ->capture_default_str();
    sub->add_option("--csv", csv, "file to write the table into");
    return sub;
}

}  // namespace mfar::eval
