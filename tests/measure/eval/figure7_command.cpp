#include "tests/measure/eval/figure7_command.h"

#include "tests/measure/eval/name_options.h"
#include "tests/measure/eval/picture_metrics_option.h"

#include <fmt/format.h>

namespace mfar::eval {
namespace {

constexpr const char* kFigure7Help =
    "The paper's Figure 7 again: ground truth, the product (detail), the paper's blending on the\n"
    "product's flow (blend), the paper's method on OpenCV (paper), bicubic and bilinear\n"
    "up-scaling, on luma (Rec. 601) without 32 px of border. Synthetic scenes are hand-held with\n"
    "exact poses; a still every ten frames, the fifth after it is measured. Recordings as for\n"
    "superres. A frame of 2304x1728 takes about 80 s of CPU time.\n";

}  // namespace

CLI::App* addFigure7Command(CLI::App& app, Figure7Request& request, std::string& csv) {
    CLI::App* sub =
        app.add_subcommand("figure7", "measure quality and sharpness as in Figure 7 of the paper");
    sub->footer(std::string(kFigure7Help) + kPictureMetricsHelp);
    sub->add_option("recording", request.recordings, "recordings, folders with truth/highres");
    addNames(*sub, "--scenes", request.scenes,
             "synthetic scenes of mfar-sim (default: office,shelf,outdoor)", synthetic::sceneNamed);
    sub->add_flag_callback(
           "--recordings-only", [&request] { request.scenes.clear(); },
           "measure no synthetic scenes")
        ->excludes("--scenes");
    sub->add_option("--frames", request.frames, "number of frames of each scene, at most")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    sub->add_option("--learn", request.learn,
                    "let mfar learn from this many stills of each scene or recording before")
        ->check(CLI::Range(0, 1000));
    addMetricParameters(*sub, request.metrics);
    sub->add_option("--svg", request.svg, "file to write the figure into");
    sub->add_option("--save", request.save, "folder to write the pictures into");
    sub->add_option("--csv", csv, "file to write the table into");
    return sub;
}

Report runFigure7(const Figure7Request& request) {
    const auto scenes = evaluateFigure7(request);
    if (scenes.empty()) throw EvalError("figure7 needs a scene or a recording; both are missing");
    if (!request.svg.empty()) writeText(request.svg, figure7Svg(scenes, request.metrics));
    fmt::print("{}", figure7Summary(scenes));
    return figure7Report(scenes, request.metrics);
}

}  // namespace mfar::eval
