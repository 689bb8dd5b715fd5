#include "tests/measure/eval/pose_command.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kPoseHelp =
    "Takes recordings with poses and tags.toml, and folders with NAME.jpg|png and the corners of "
    "the tags in NAME.txt.\n"
    "Recordings: rot_deg, trans_mm: of the camera against the recorded pose; trans_percent: of the "
    "mean distance to the tags seen; jitter: change of the error since the frame before; ms: "
    "search "
    "and pose of the frame; missed: frames without a pose; the rows `median` carry in flips how "
    "often the error turned by more than 3 degrees from one frame to the next.\n"
    "Pictures: corner_px: root mean square distance to the corners given; found, missed, false: "
    "tags.";

}  // namespace

CLI::App* addPoseCommand(CLI::App& app, PoseRequest& request, std::string& csv) {
    CLI::App* sub =
        app.add_subcommand("pose", "camera poses and tag corners against the true ones");
    sub->footer(kPoseHelp);
    request.methods = poseMethodNames();
    sub->add_option("folder", request.folders, "recordings or folders of pictures")->required();
    sub->add_option("--methods", request.methods,
                    fmt::format("of: {}", fmt::join(poseMethodNames(), ", ")))
        ->delimiter(',');
    sub->add_option("--frames", request.frames, "at most so many frames of each folder")
        ->check(CLI::Range(1, 1000000));
    TrackerOptions& tracker = request.tracker;
    sub->add_option("--decimation", tracker.decimation, "of the picture in which quads are sought")
        ->capture_default_str();
    sub->add_option("--threads", tracker.threads, "of libapriltag")->capture_default_str();
    sub->add_option("--full-search-interval", tracker.fullSearchInterval,
                    "frames between searches of the whole picture")
        ->capture_default_str();
    sub->add_option("--gamma", tracker.gamma, "of the video sensor, for the corners")
        ->capture_default_str();
    sub->add_option("--still-gamma", tracker.stillGamma, "of the still sensor")
        ->capture_default_str();
    sub->add_option("--csv", csv, "file for the table");
    return sub;
}

}  // namespace mfar::eval
