#include "tests/measure/eval/bars.h"
#include "tests/measure/eval/depth.h"
#include "tests/measure/eval/depth_methods.h"
#include "tests/measure/eval/figure7_command.h"
#include "tests/measure/eval/flow.h"
#include "tests/measure/eval/flow_methods.h"
#include "tests/measure/eval/metric_command.h"
#include "tests/measure/eval/occlusion_command.h"
#include "tests/measure/eval/picture_metrics_option.h"
#include "tests/measure/eval/pose_command.h"
#include "tests/measure/eval/pose_source_option.h"
#include "tests/measure/eval/program_end.h"
#include "tests/measure/eval/superres.h"
#include "tests/measure/eval/superres_learning.h"
#include "tests/measure/eval/superres_methods.h"
#include "tests/measure/eval/traced_commands.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace {

using namespace mfar;
using namespace mfar::eval;

constexpr const char* kSuperResHelp =
    "Enlarges every video frame with truth/highres to the still's resolution and compares it\n"
    "with the truth.\n"
    "Luma (Rec. 601), 32 px of border left out. harm_rate: share of pixels whose error\n"
    "exceeds bicubic's by more than 2 grey levels. psnr_rgb_db: over red, green and blue.\n"
    "tiles_below: share of the 64x64 output tiles whose root mean square error exceeds\n"
    "bicubic's by more than 0.25 grey levels; incomplete tiles at the right and bottom are\n"
    "left out.\n"
    "flicker: deviation of the error from one frame to the next along the true motion [grey\n"
    "levels], where truth/flow has it.\n"
    "--classes adds three classes of pixels: outside of the still's view, unmatched (hidden\n"
    "in the still, or confidence below 0.5), and matched; for each class its share and the\n"
    "gain of every method over bicubic.\n"
    "The reference of a frame is the still nearest to it in time that does not show the\n"
    "frame's own view: a still whose pose relative to the frame is below 1e-6 (from the rig\n"
    "at equal times, from the recorded poses otherwise) is never used.\n"
    "ms: time of a second run on the same frame with every tile computed, without the work\n"
    "per still.\n";

constexpr const char* kFlowHelp =
    "Takes recordings with truth/flow from video frames to stills, or else with\n"
    "truth/inverse_depth and known poses (a scene at rest; occluded pixels are found by\n"
    "projecting the truth into the still), or else with truth/flow between video frames; and\n"
    "folders with frameNN.png frameMM.png flowNN.flo.\n"
    "Flow is in video pixels, to the still at the video's geometry (rotation of the rig and\n"
    "both lenses, no parallax); the reference of a frame is chosen as for superres.\n"
    "epe_px: mean end-point error where truth and answer are known; bad1, bad2: share of the\n"
    "pixels with known truth that are off by more than 1, 2 px or have no answer; ms: median\n"
    "of 3 runs after one to warm up, without work per still. flow2d and dis-medium-both\n"
    "compute both directions; the time of sgbm and stereobm covers rectifying and matching.\n"
    "sgbm and stereobm need poses; they have no answer where the camera does not move or the\n"
    "two pictures cannot be rectified, and fill pixels without a match with the farther\n"
    "neighbour.\n"
    "angular_deg: mean angle between truth and answer as vectors (u, v, 1). ause: area\n"
    "between two curves of the mean error of the remaining pixels while pixels are removed,\n"
    "one in the order of confidence (eq. 2), one in the order of error; both are 1 when no\n"
    "pixel is removed. 0: the least confident pixels are the worst. ause_rel: ause divided by\n"
    "that of a random order.";

constexpr const char* kDepthHelp =
    "Takes recordings with truth/inverse_depth and known poses (a scene at rest); frames,\n"
    "their references, what is hidden, and time as for flow. Every method's flow is\n"
    "triangulated:\n"
    "flow: the product's, along epipolar lines, in closed form; midpoint: the same by the\n"
    "paper's shortest line between both rays; sgbm, stereobm: as for flow.\n"
    "absrel: median of |z - true z| / true z where depth and truth are known; bad1: share of\n"
    "the pixels with known truth that are off by more than 1 px of disparity (focal length\n"
    "times baseline times inverse depth) or have no depth; completeness: share of them with a\n"
    "depth; edge_: within 4 px of an edge, where neighbouring true depths differ by a tenth;\n"
    "inner_: elsewhere; delta1, 2, 3: share of the pixels whose two depths are within a\n"
    "factor of 1.25, its square, its cube; ause, ause_rel: as for flow, with the error of\n"
    "disparities and the variance that the depth states.";

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

void checkMethods(const std::vector<std::string>& asked, const std::vector<std::string>& valid) {
    for (const std::string& name : asked)
        if (std::find(valid.begin(), valid.end(), name) == valid.end())
            throw EvalError(fmt::format("unknown method '{}' (valid: {})", name, joined(valid)));
}

struct Options {
    SuperResRequest superres;
    SampleRequest flow, depth;
    PoseRequest pose;
    OcclusionRequest occlusion;
    MetricRequest metric;
    Figure7Request figure7;
    std::string degrade, degradeVideo;
    PoseNoise poseNoise;
    std::string csv;
    std::filesystem::path svg;
};

/// Needed because CLI::Range accepts NaN.
std::string isAngle(const std::string& text) {
    double degrees = -1;
    const bool number = CLI::detail::lexical_cast(text, degrees);
    return number && degrees >= 0 && degrees <= 180 ? "" : text + " is not from 0 to 180";
}

/// Adds the options for disturbances, which all tasks share.
void addDisturbances(CLI::App& sub, Options& o) {
    sub.add_option("--degrade", o.degrade,
                   "degrade the still: gain=0.7,gamma=1.3,blur=0.7,noise=4; applied as blur "
                   "(sigma, still px), gain, v^gamma, noise (sigma, grey levels)");
    sub.add_option("--pose-noise-deg", o.poseNoise.degrees,
                   "rotate the pose of every frame by this angle about a random axis; all runs use "
                   "the same axes")
        ->check(isAngle);
    sub.add_option("--pose-noise-seed", o.poseNoise.seed, "seed of the random axes");
}

void addStills(CLI::App& sub, SuperResRequest& request) {
    sub.add_option(
           "--stills", request.stills,
           "number of stills; 2: give mfar a second still, the one next to the reference in time")
        ->check(CLI::Range(1, 2));
    sub.add_option(
           "--learn", request.learn,
           "before the measurement, learn filters from this many matched stills of the recording")
        ->check(CLI::Range(1, 100000));
    sub.add_option(
        "--learn-from", request.learnFrom,
        "learn filters from these recordings; without --learn, from each of their stills once");
}

CLI::App* addSuperRes(CLI::App& app, Options& o) {
    CLI::App* sub =
        app.add_subcommand("superres", "compare super-resolved frames with truth/highres");
    sub->footer(std::string(kSuperResHelp) + kPictureMetricsHelp);
    o.superres.methods = superResMethodNames();
    sub->add_option("recording", o.superres.recordings, "recordings, folders in the EuRoC layout")
        ->required();
    sub->add_option("--methods", o.superres.methods, "of: " + joined(superResMethodNames()))
        ->delimiter(',');
    sub->add_option(
        "--dnn-model", o.superres.dnnModels,
        "files of OpenCV's dnn_superres as further peers: EDSR_x4.pb, or ESPCN, FSRCNN, "
        "LapSRN and their factor");
    sub->add_flag("--classes", o.superres.classes,
                  "report separately the pixels that the still shows, that it does not show, and "
                  "that lie outside of its view");
    addPoseSource(*sub, o.superres.poses);
    addDisturbances(*sub, o);
    sub->add_option("--degrade-video", o.degradeVideo,
                    "degrade the video in the same way [video px]");
    addPictureMetrics(*sub, o.superres.metrics);
    sub->add_option(
           "--alpha", o.superres.alpha,
           "for the peer `paper`: two-way error at which its confidence is zero [video px]")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    sub->add_flag("--no-still", o.superres.noStill,
                  "give no still to any method, and leave out those that need one")
        ->excludes("--classes");
    addStills(*sub, o.superres);
    sub->add_option("--frames", o.superres.frames,
                    "measure at most this many frames of each recording")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--save", o.superres.save,
                    "folder to write the pictures of every method and of the truth into");
    sub->add_option("--csv", o.csv, "file for the table");
    return sub;
}

CLI::App* addSamples(CLI::App& app, const char* name, const char* what, const char* help,
                     const std::vector<std::string>& methods, SampleRequest& request, Options& o) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->footer(help);
    request.methods = methods;
    sub->add_option("folder", request.folders, "recordings, or pairs of two frames")->required();
    sub->add_option("--methods", request.methods, "of: " + joined(methods))->delimiter(',');
    addPoseSource(*sub, request.poses);
    addDisturbances(*sub, o);
    sub->add_option("--frames", request.frames, "measure at most this many frames of each folder")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--csv", o.csv, "file for the table");
    return sub;
}

/// Completes the request with the options that all tasks share.
const SampleRequest& completed(SampleRequest& request, const std::vector<std::string>& methods,
                               const Options& o) {
    checkMethods(request.methods, methods);
    request.degradation = parseDegradation(o.degrade);
    request.poseNoise = o.poseNoise;
    return request;
}

Report runSuperRes(Options& o) {
    checkMethods(o.superres.methods, superResMethodNames());
    o.superres.degradation = parseDegradation(o.degrade);
    o.superres.videoDegradation = parseDegradation(o.degradeVideo, "--degrade-video");
    o.superres.poseNoise = o.poseNoise;
    if (!o.superres.learnFrom.empty() && o.superres.learn == 0) o.superres.learn = kEachOnce;
    if (o.superres.noStill) std::erase_if(o.superres.methods, needsStill);
    return evaluateSuperRes(o.superres);
}

Report runPose(const Options& o) {
    checkMethods(o.pose.methods, poseMethodNames());
    return evaluatePose(o.pose);
}

/// Adds all subcommands. They store their options in `o`.
std::vector<EvalCommand> addCommands(CLI::App& app, Options& o) {
    std::vector<EvalCommand> out = addTracedCommands(app, o.csv);
    // `evaluate` uses `request`, which gets the progress before.
    const auto add = [&](CLI::App* command, auto& request, auto evaluate) {
        out.push_back({command, [&request, evaluate](const ProgressPart& progress) {
                           request.progress = progress;
                           return evaluate();
                       }});
    };
    add(addSuperRes(app, o), o.superres, [&o] { return runSuperRes(o); });
    add(addPoseCommand(app, o.pose, o.csv), o.pose, [&o] { return runPose(o); });
    add(addSamples(app, "depth", "compare depth with the ground truth", kDepthHelp,
                   depthMethodNames(), o.depth, o),
        o.depth, [&o] { return evaluateDepth(completed(o.depth, depthMethodNames(), o)); });
    add(addSamples(app, "flow", "compare dense flow with the ground truth", kFlowHelp,
                   flowMethodNames(), o.flow, o),
        o.flow, [&o] { return evaluateFlow(completed(o.flow, flowMethodNames(), o)); });
    add(addOcclusionCommand(app, o.occlusion, o.csv), o.occlusion,
        [&o] { return evaluateOcclusion(o.occlusion); });
    add(addMetricCommand(app, o.metric, o.csv), o.metric,
        [&o] { return evaluateMetric(o.metric); });
    add(addFigure7Command(app, o.figure7, o.csv), o.figure7,
        [&o] { return runFigure7(o.figure7); });
    out.back().hasOwnPlot = true;
    for (const EvalCommand& each : out)
        if (!each.hasOwnPlot)
            each.command->add_option("--svg", o.svg, "file to write a plot of the means into");
    return out;
}

int run(int argc, char** argv) {
    CLI::App app("mfar-eval: measures accuracy and run time of mfar and its peers on recordings");
    app.require_subcommand(1);
    Options o;
    const std::vector<EvalCommand> commands = addCommands(app, o);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : kWrongInput;
    }
    const auto used = std::ranges::find_if(
        commands, [](const EvalCommand& command) { return command.command->parsed(); });
    Progress progress;
    const Report report = used->evaluate(ProgressPart(progress));
    progress.clear();
    fmt::print("{}", report.table());
    if (!o.csv.empty()) report.writeCsv(o.csv);
    if (!o.svg.empty())
        writeText(o.svg, barsSvg("mfar-eval " + used->command->get_name(), barsOf(report),
                                 "Bars and large points are means. Small circles are recordings, "
                                 "or frames if there is only one recording."));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        return endedBy(error, "mfar-eval");
    }
}
