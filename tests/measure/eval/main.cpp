#include "daemon/after_output.h"
#include "daemon/number_range.h"
#include "daemon/output_checks.h"
#include "daemon/tools/command_failure.h"
#include "tests/measure/eval/bars.h"
#include "tests/measure/eval/depth.h"
#include "tests/measure/eval/depth_methods.h"
#include "tests/measure/eval/engine_option.h"
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
    "Enlarges every video frame that has a true picture (truth/highres) to the still's\n"
    "resolution and compares the result with that picture.\n"
    "Errors are those of luma (Rec. 601), without 32 px of border. psnr_rgb_db: PSNR of red,\n"
    "green and blue. harm_rate: share of the pixels whose error exceeds that of bicubic\n"
    "enlargement by more than 2 grey levels. tiles_below: share of the 64x64 px output tiles\n"
    "whose root mean square error exceeds bicubic's by more than 0.25 grey levels; incomplete\n"
    "tiles at the right and bottom are left out.\n"
    "flicker: root mean square change of the error from one frame to the next along the true\n"
    "motion, over the square root of two [grey levels]; needs truth/flow between both frames.\n"
    "--classes divides the pixels into three classes: outside of the still's view; unmatched\n"
    "(occluded in the still, or confidence below 0.5); matched. For each class, the table\n"
    "shows its share of the pixels and the gain of every method over bicubic.\n"
    "The reference of a frame is the still nearest to it in time. Stills taken from the same\n"
    "viewpoint and direction (less than 1e-6 m and 1e-6 rad away) are left out: such a still\n"
    "would be the true picture itself. If still and frame have the same time, their relative\n"
    "pose is that of the rig; otherwise it also depends on the recorded poses.\n"
    "ms: time of a second run on the same frame, in which every tile is computed, without the\n"
    "work per still.\n";

constexpr const char* kFlowHelp =
    "A folder holds a pair of frames (frameNN.png, frameMM.png, flowNN.flo) or a recording.\n"
    "The truth of a recording is the first of these that exists: truth/flow from video frames\n"
    "to stills; truth/inverse_depth with known poses, for a scene at rest (occluded pixels are\n"
    "found by projecting the truth into the still); truth/flow between video frames.\n"
    "Flow leads from the frame to the second picture that the file in truth/flow names or, with\n"
    "truth/inverse_depth, to the still that superres would choose. Flow is in video pixels: the\n"
    "still is first resampled to the video's geometry (rotation of the rig and both lenses, no\n"
    "parallax).\n"
    "epe_px: mean end-point error where truth and result are known; bad1, bad2: share of the\n"
    "pixels with known truth that are off by more than 1 px, 2 px or have no result; coverage:\n"
    "share of the pixels with known truth that have a result; ms:\n"
    "median time of three runs after one that warms up, without work per still. flow2d and\n"
    "dis-medium-both compute both directions; the time of sgbm and stereobm covers\n"
    "rectification and matching. sgbm and stereobm need poses. They have no result if both\n"
    "pictures were taken from the same position or cannot be rectified. Pixels without a match\n"
    "get the value of their farther neighbour in the row.\n"
    "angular_deg: mean angle between truth and result as vectors (u, v, 1).\n"
    "ause tells whether confidence (eq. 2 of the paper) is low where errors are large. Pixels\n"
    "are removed, the least confident first, and the mean error of the remaining ones is\n"
    "recorded as a curve that starts at 1. ause is the area between this curve and the best\n"
    "one, for which the largest errors are removed first. 0: the order of the confidences is\n"
    "the best. ause_rel: ause divided by the ause of a random order.";

constexpr const char* kDepthHelp =
    "Takes recordings with truth/inverse_depth and known poses, of a scene at rest. Stills,\n"
    "occluded pixels and times are as for the subcommand flow with truth/inverse_depth, but\n"
    "the time of the method depth is that of a single run. All other methods find flow and\n"
    "triangulate it.\n"
    "flow: mfar's flow along epipolar lines, triangulated in closed form; midpoint: the same\n"
    "flow, triangulated by the midpoint of the shortest line between both rays, as in the\n"
    "paper; sgbm, stereobm: see mfar-eval flow.\n"
    "absrel: median of |z - true z| / true z where depth and truth are known; bad1: share of\n"
    "the pixels with known truth that are off by more than 1 px of disparity (focal length\n"
    "times baseline times inverse depth) or have no depth; completeness: share of the pixels\n"
    "with known truth that have a depth; edge_...: within 4 px of a depth edge, where\n"
    "neighbouring true depths differ by more than a tenth; inner_...: elsewhere; delta1,\n"
    "delta2, delta3: share of the pixels whose depth differs from the true one by less than a\n"
    "factor of 1.25, 1.25^2, 1.25^3; ause, ause_rel: as for flow, with the error of the\n"
    "disparity and the variance that the method reports with its depth.";

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

void checkMethods(const std::vector<std::string>& asked, const std::vector<std::string>& valid) {
    for (const std::string& name : asked)
        if (std::find(valid.begin(), valid.end(), name) == valid.end())
            throw EvalError(
                fmt::format("--methods: unknown method '{}' (valid: {})", name, joined(valid)));
}

struct Options {
    SuperResRequest superres;
    SampleRequest flow, depth;
    PoseRequest pose;
    OcclusionRequest occlusion;
    MetricRequest metric;
    Figure7Request figure7;
    std::string degrade, degradeVideo, engine = "auto";
    PoseNoise poseNoise;
    std::string csv;
    std::filesystem::path svg;
};

void addDisturbances(CLI::App& sub, Options& o) {
    sub.add_option("--degrade", o.degrade,
                   "degrade the still, for example gain=0.7,gamma=1.3,blur=0.7,noise=4; applied in "
                   "this order: blur (sigma [still px]), gain (factor), gamma (v^gamma), noise "
                   "(sigma [grey levels])");
    sub.add_option("--pose-noise-deg", o.poseNoise.degrees,
                   "rotate the pose of every frame by this angle about a random axis; all runs use "
                   "the same axes")
        ->check(numberFrom(0, 180));
    sub.add_option("--pose-noise-seed", o.poseNoise.seed,
                   "seed of the random axes of --pose-noise-deg")
        ->check(unsigned64())
        ->needs("--pose-noise-deg");
}

void checkPoseNoise(const Options& o, PoseSource poses) {
    if (o.poseNoise.degrees > 0 && poses == PoseSource::None)
        throw EvalError("--pose-noise-deg needs poses, but --poses is none");
}

void addStills(CLI::App& sub, SuperResRequest& request) {
    sub.add_flag("--no-still", request.noStill,
                 "give no still to the methods, and leave out methods that need one")
        ->excludes("--classes");
    sub.add_option("--stills", request.stills,
                   "number of stills that mfar gets for each frame; 2: also the second-nearest "
                   "still in time")
        ->check(CLI::Range(1, 2))
        ->excludes("--no-still");
    sub.add_option(
           "--learn", request.learn,
           "before the measurement, learn filters from this many matched stills of the recording")
        ->check(CLI::Range(1, 100000));
    sub.add_option(
        "--learn-from", request.learnFrom,
        "learn filters from these recordings instead of the measured one; without --learn, from "
        "each of their stills once");
}

CLI::App* addSuperRes(CLI::App& app, Options& o) {
    CLI::App* sub =
        app.add_subcommand("superres", "compare super-resolved frames with truth/highres");
    sub->footer(std::string(kSuperResHelp) + kPictureMetricsHelp);
    o.superres.methods = superResMethodNames();
    sub->add_option("recording", o.superres.recordings,
                    "folders of recordings, in the EuRoC layout")
        ->required();
    sub->add_option("--methods", o.superres.methods,
                    "methods to measure: any of " + joined(superResMethodNames()))
        ->delimiter(',');
    sub->add_option(
        "--dnn-model", o.superres.dnnModels,
        "model files for OpenCV's dnn_superres, measured as further methods; a file's name is "
        "EDSR, ESPCN, FSRCNN or LapSRN and the factor, as in EDSR_x4.pb");
    sub->add_flag("--classes", o.superres.classes,
                  "report three groups of pixels separately: matched with the still, unmatched, "
                  "and outside of the still's view");
    addPoseSource(*sub, o.superres.poses);
    addDisturbances(*sub, o);
    sub->add_option("--degrade-video", o.degradeVideo,
                    "degrade the video; values as in --degrade, but blur in video px");
    addPictureMetrics(*sub, o.superres.metrics);
    sub->add_option(
           "--alpha", o.superres.alpha,
           "two-way error of the flow at which the confidence of the method `paper` is zero [video "
           "px]")
        ->check(numberFrom(1e-6, 1e6))
        ->capture_default_str();
    addStills(*sub, o.superres);
    sub->add_option("--frames", o.superres.frames,
                    "measure at most this many frames of each recording")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--save", o.superres.save,
                    "folder to write the pictures of every method and of the truth into");
    sub->add_option("--csv", o.csv, "file to write the table into")->check(fileToWrite());
    return sub;
}

CLI::App* addSamples(CLI::App& app, const char* name, const char* what, const char* help,
                     const std::vector<std::string>& methods, SampleRequest& request, Options& o) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->footer(help);
    request.methods = methods;
    sub->add_option("folder", request.folders, "folders of recordings, or of pairs of frames")
        ->required();
    sub->add_option("--methods", request.methods, "methods to measure: any of " + joined(methods))
        ->delimiter(',');
    addPoseSource(*sub, request.poses);
    addDisturbances(*sub, o);
    sub->add_option("--frames", request.frames, "measure at most this many frames of each folder")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--csv", o.csv, "file to write the table into")->check(fileToWrite());
    return sub;
}

const SampleRequest& completed(SampleRequest& request, const std::vector<std::string>& methods,
                               const Options& o) {
    checkMethods(request.methods, methods);
    checkPoseNoise(o, request.poses);
    request.degradation = parseDegradation(o.degrade);
    request.poseNoise = o.poseNoise;
    return request;
}

Report runSuperRes(Options& o) {
    checkMethods(o.superres.methods, superResMethodNames());
    checkPoseNoise(o, o.superres.poses);
    o.superres.degradation = parseDegradation(o.degrade);
    o.superres.videoDegradation = parseDegradation(o.degradeVideo, "--degrade-video");
    o.superres.poseNoise = o.poseNoise;
    if (!o.superres.learnFrom.empty() && o.superres.learn == 0) o.superres.learn = kEachOnce;
    if (o.superres.noStill) std::erase_if(o.superres.methods, needsStill);
    if (o.superres.methods.empty() && o.superres.dnnModels.empty())
        throw EvalError("no method remains: with --no-still, methods that need a still are left "
                        "out");
    return evaluateSuperRes(o.superres);
}

Report runPose(const Options& o) {
    checkMethods(o.pose.methods, poseMethodNames());
    return evaluatePose(o.pose);
}

std::vector<EvalCommand> addCommands(CLI::App& app, Options& o) {
    std::vector<EvalCommand> out = addTracedCommands(app, o.csv);
    // Sets request.progress first, because `evaluate` shows its progress there.
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
    addEngine(app, o.engine);
    for (const EvalCommand& each : out)
        each.command->fallthrough();  // so that --engine may stand after the command
    for (const EvalCommand& each : out)
        if (!each.hasOwnPlot)
            each.command->add_option("--svg", o.svg, "file to write a plot of the means into")
                ->check(fileToWrite());
    return out;
}

int run(int argc, char** argv) {
    CLI::App app(
        "mfar-eval: measures accuracy and run time of mfar and of other methods on recordings",
        "mfar-eval");
    app.require_subcommand(1);
    app.failure_message(commandFailure);
    Options o;
    const std::vector<EvalCommand> commands = addCommands(app, o);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : kWrongInput;
    }
    const auto used = std::ranges::find_if(
        commands, [](const EvalCommand& command) { return command.command->parsed(); });
    const CLI::Option* svg = used->command->get_option_no_throw("--svg");
    if (svg != nullptr && svg->count() > 0 && o.csv == svg->as<std::string>())
        throw EvalError("--csv and --svg name the same file");
    // The command metric compares files and draws nothing.
    if (used->command->get_name() != "metric") useEngine(o.engine);
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
        return afterOutput(run(argc, argv), "mfar-eval", 1);
    } catch (const std::exception& error) {
        return endedBy(error, "mfar-eval");
    }
}
