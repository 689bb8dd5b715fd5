#include "tests/measure/eval/figure7_command.h"

#include "daemon/output_checks.h"
#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/picture_metrics_option.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kFigure7Help =
    "Repeats Figure 7 of the paper. Methods: ground truth, mfar (its mode detail), the paper's\n"
    "blending with mfar's flow (mode blend), the paper's method with OpenCV's flow (paper),\n"
    "bicubic and bilinear enlargement. Values are those of luma (Rec. 601) without 32 px of\n"
    "border. Synthetic scenes are seen by a hand-held camera with exact poses: a still is\n"
    "requested every ten frames, and the fifth frame after each request is measured.\n"
    "Recordings need truth/highres, as for superres. A frame of 2304x1728 takes about 80 s of\n"
    "CPU time.\n";

}  // namespace

CLI::App* addFigure7Command(CLI::App& app, Figure7Request& request, std::string& csv) {
    CLI::App* sub =
        app.add_subcommand("figure7", "measure quality and sharpness as in Figure 7 of the paper");
    sub->footer(std::string(kFigure7Help) + kPictureMetricsHelp);
    sub->add_option("recording", request.recordings,
                    "folders of recordings that have truth/highres");
    addNames(*sub, "--scenes", request.scenes,
             "synthetic scenes of mfar-sim (default: office,shelf,outdoor)", synthetic::sceneNamed);
    sub->add_flag_callback(
           "--recordings-only", [&request] { request.scenes.clear(); },
           "measure no synthetic scenes")
        ->excludes("--scenes");
    sub->add_option("--frames", request.frames,
                    "measure at most this many frames of each scene or recording")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub->add_option(
           "--learn", request.learn,
           "number of stills of each scene or recording from which mfar learns its filters "
           "before the measurement")
        ->check(CLI::Range(0, 1000));
    addMetricParameters(*sub, request.metrics);
    sub->add_option("--svg", request.svg, "file to write the figure into")->check(fileToWrite());
    sub->add_option("--save", request.save, "folder to write the pictures into");
    sub->add_option("--csv", csv, "file to write the table into")->check(fileToWrite());
    return sub;
}

Report runFigure7(const Figure7Request& request) {
    const auto scenes = evaluateFigure7(request);
    if (scenes.empty())
        throw EvalError("figure7 needs a scene (--scenes) or a recording; both are missing");
    if (!request.svg.empty()) writeText(request.svg, figure7Svg(scenes, request.metrics));
    fmt::print("{}", figure7Summary(scenes));
    return figure7Report(scenes, request.metrics);
}

}  // namespace mfar::eval
