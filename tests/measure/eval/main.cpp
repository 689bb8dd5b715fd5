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
    "Brings every video frame with truth/highres to the still's resolution and compares it "
    "with the truth.\n"
    "Luma (Rec. 601), 32 px of border left out. harm_rate: share of pixels whose error "
    "exceeds bicubic's by more than 2 grey levels. psnr_rgb_db: over red, green and blue.\n"
    "tiles_below: share of the 64x64 output tiles whose root mean square error exceeds bicubic's\n"
    "by more than 0.25 grey levels; incomplete tiles at the right and bottom are left out.\n"
    "flicker: deviation of the error from one frame to the next along the true motion [grey\n"
    "levels], where truth/flow has it.\n"
    "--classes adds for pixels outside the still's view, unmatched (hidden there, or confidence\n"
    "below 0.5) and matched their share and what each method gains there over bicubic.\n"
    "The reference of a frame is the still nearest to it in time that does not show the "
    "frame's very own view: a still whose pose relative to the frame is below 1e-6 (from the "
    "rig at equal times, from the recorded poses otherwise) is never used.\n"
    "ms: a second run on the same frame, every tile computed; work per still is not in it.\n";

constexpr const char* kFlowHelp =
    "Takes recordings with truth/flow from video frames to stills, or else with\n"
    "truth/inverse_depth and known poses (a scene at rest; occluded pixels found by projecting\n"
    "the truth into the still), or else with truth/flow between video frames; and folders with\n"
    "frameNN.png frameMM.png flowNN.flo.\n"
    "Flow is in video pixels, to the still at the video's geometry (rotation of the rig and both\n"
    "lenses, no parallax); the reference of a frame is chosen as for superres.\n"
    "epe_px: mean end-point error where truth and answer are known; bad1, bad2: share of the\n"
    "pixels with known truth off by more than 1, 2 px, no answer is off; ms: median of 3 runs\n"
    "after one to warm up, without work per still. flow2d and dis-medium-both compute both\n"
    "directions; that of sgbm and stereobm is that of rectifying and matching.\n"
    "sgbm and stereobm need poses; they have no answer where the camera moves into the picture or\n"
    "not at all, and fill what they leave open with the farther neighbour.\n"
    "angular_deg: mean angle between both as (u, v, 1). ause: area between two curves of the mean\n"
    "error of what is left as pixels are taken away, by confidence (eq. 2) and by error, 1 where\n"
    "all are left; 0: the least confident are the worst. ause_rel: over what a random order gets.";

constexpr const char* kDepthHelp =
    "Takes recordings with truth/inverse_depth and known poses (a scene at rest); frames, their\n"
    "references, what is hidden, and time as for flow. Every method's flow is triangulated:\n"
    "flow: the product's, along epipolar lines, in closed form; midpoint: the same by the paper's\n"
    "shortest line between both rays; sgbm, stereobm: as for flow.\n"
    "absrel: median of |z - true z| / true z where depth and truth are known; bad1: share of the\n"
    "pixels with known truth that are off by more than 1 px of disparity (focal length times\n"
    "baseline times inverse depth), no depth is off; completeness: share of them with a depth;\n"
    "edge_, inner_: within 4 px of an edge, where true depths side by side differ by a tenth, and\n"
    "elsewhere; delta1, 2, 3: share with both depths within a factor of 1.25, its square, its\n"
    "cube; ause, ause_rel: as for flow, of disparities by the variance that the depth states.";

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

/// CLI::Range accepts NaN.
std::string isAngle(const std::string& text) {
    double degrees = -1;
    const bool number = CLI::detail::lexical_cast(text, degrees);
    return number && degrees >= 0 && degrees <= 180 ? "" : text + " is not in [0, 180]";
}

/// Options for disturbances, common to all tasks.
void addDisturbances(CLI::App& sub, Options& o) {
    sub.add_option("--degrade", o.degrade,
                   "make the still worse: gain=0.7,gamma=1.3,blur=0.7,noise=4; applied as blur "
                   "(sigma, still px), gain, v^gamma, noise (sigma, grey levels)");
    sub.add_option("--pose-noise-deg", o.poseNoise.degrees,
                   "turn the pose of every frame by so much about a random axis; the same in each "
                   "run")
        ->check(isAngle);
    sub.add_option("--pose-noise-seed", o.poseNoise.seed, "another number draws other axes");
}

CLI::App* addSuperRes(CLI::App& app, Options& o) {
    CLI::App* sub = app.add_subcommand("superres", "super-resolved frames against truth/highres");
    sub->footer(std::string(kSuperResHelp) + kPictureMetricsHelp);
    o.superres.methods = superResMethodNames();
    sub->add_option("recording", o.superres.recordings, "folders in the EuRoC layout")->required();
    sub->add_option("--methods", o.superres.methods, "of: " + joined(superResMethodNames()))
        ->delimiter(',');
    sub->add_option(
        "--dnn-model", o.superres.dnnModels,
        "files of OpenCV's dnn_superres as further peers: EDSR_x4.pb, or ESPCN, FSRCNN, "
        "LapSRN and their factor");
    sub->add_flag("--classes", o.superres.classes,
                  "tell apart what the still shows, what it does not and what lies outside");
    addPoseSource(*sub, o.superres.poses);
    addDisturbances(*sub, o);
    sub->add_option("--degrade-video", o.degradeVideo,
                    "make the video worse, in the same way [video px]");
    addPictureMetrics(*sub, o.superres.metrics);
    sub->add_option("--alpha", o.superres.alpha,
                    "of the peer `paper`: two-way error at which its confidence is zero [video px]")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    sub->add_flag("--no-still", o.superres.noStill,
                  "give no still to any method, and leave out those that need one")
        ->excludes("--classes");
    sub->add_option("--stills", o.superres.stills,
                    "2: give the product a second still, next to the reference in time")
        ->check(CLI::Range(1, 2));
    sub->add_option("--learn", o.superres.learn,
                    "learn filters from so many matched stills of the recording before")
        ->check(CLI::Range(1, 100000));
    sub->add_option("--learn-from", o.superres.learnFrom,
                    "learn them from these recordings; without --learn from each still once");
    sub->add_option("--frames", o.superres.frames, "at most so many frames of each recording")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--save", o.superres.save, "folder for the pictures of every method and truth");
    sub->add_option("--csv", o.csv, "file for the table");
    return sub;
}

CLI::App* addSamples(CLI::App& app, const char* name, const char* what, const char* help,
                     const std::vector<std::string>& methods, SampleRequest& request, Options& o) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->footer(help);
    request.methods = methods;
    sub->add_option("folder", request.folders, "recordings or two-frame pairs")->required();
    sub->add_option("--methods", request.methods, "of: " + joined(methods))->delimiter(',');
    addPoseSource(*sub, request.poses);
    addDisturbances(*sub, o);
    sub->add_option("--frames", request.frames, "at most so many frames of each folder")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--csv", o.csv, "file for the table");
    return sub;
}

/// The request, completed by the options common to all tasks.
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

/// All subcommands; they store their options in `o`.
std::vector<EvalCommand> addCommands(CLI::App& app, Options& o) {
    std::vector<EvalCommand> out = addTracedCommands(app, o.csv);
    // `request` gets the progress before `evaluate` uses it.
    const auto add = [&](CLI::App* command, auto& request, auto evaluate) {
        out.push_back({command, [&request, evaluate](const ProgressPart& progress) {
                           request.progress = progress;
                           return evaluate();
                       }});
    };
    add(addSuperRes(app, o), o.superres, [&o] { return runSuperRes(o); });
    add(addPoseCommand(app, o.pose, o.csv), o.pose, [&o] { return runPose(o); });
    add(addSamples(app, "depth", "depth against the true one", kDepthHelp, depthMethodNames(),
                   o.depth, o),
        o.depth, [&o] { return evaluateDepth(completed(o.depth, depthMethodNames(), o)); });
    add(addSamples(app, "flow", "dense flow against the true one", kFlowHelp, flowMethodNames(),
                   o.flow, o),
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
            each.command->add_option("--svg", o.svg, "file for a plot of the means");
    return out;
}

int run(int argc, char** argv) {
    CLI::App app("mfar-eval: accuracy and run time of this product and its peers on recordings");
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
                                 "Bars and large points: means. Small circles: recordings, or "
                                 "frames of a single one."));
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
