#include "tests/measure/eval/slicing_command.h"

#include "daemon/output_checks.h"
#include "tests/measure/eval/picture_options.h"

#include <cmath>
#include <string>

namespace mfar::eval {
namespace {

constexpr const char* kSlicingHelp =
    "Path-traces balls and boxes on a plane with several methods. time: time slices, one\n"
    "sample of every pixel again and again; spatial: spatial slices, tile after tile with all\n"
    "samples; time-adaptive, spatial-adaptive: pixels with little noise get no more samples;\n"
    "full: the whole picture at once.\n"
    "ms: processor time of one thread until the row's number of samples per pixel; rmse: root\n"
    "mean square error against a picture of many samples [grey levels of premultiplied RGBA,\n"
    "inside the objects' bounds]; rmse_filtered: the error after the noise was smoothed, as in\n"
    "mfard.\n"
    "Tiles that spatial slices have not reached yet are empty.\n"
    "Rows `frames`: a picture is divided into 64 frames with equal numbers of samples. ms:\n"
    "mean time of a frame; frame_cv, frame_p95, frame_max: standard deviation, 95th percentile\n"
    "and maximum of the times, divided by their mean.\n"
    "Rows `budget`: mfard's tracer keeps to the budget of processor time in each frame\n"
    "while the view turns by 3 degrees per second. budget_mean: used time of all frames\n"
    "divided by their budget; budget_p95_off: 95th percentile of the deviation of this\n"
    "quotient from 1, over single frames.";

}  // namespace

CLI::App* addSlicingCommand(CLI::App& app, SlicingRequest& request) {
    CLI::App* sub = app.add_subcommand(
        "slicing",
        "compare orders of path tracing: a few samples of every pixel in turn, tile by tile, and "
        "the whole picture at once");
    sub->footer(kSlicingHelp);
    addSize(*sub, request.size, "picture");
    sub->add_option("--samples", request.samples, "samples per pixel of a finished picture")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--truth-samples", request.truthSamples, "samples per pixel of the truth")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--budget", request.budgetMs, "budget of processor time per frame [ms]")
        ->check(isBudget())
        ->capture_default_str();
    sub->add_option("--frames", request.frames, "number of frames that the rows `budget` count")
        ->check(CLI::Range(1, 300))
        ->capture_default_str();
    sub->add_option("--threads", request.threads,
                    "number of threads for the truth and for the frames of the rows `budget`")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    sub->add_option("--svg", request.svg, "file to write a plot of error against time into")
        ->check(fileToWrite());
    return sub;
}

}  // namespace mfar::eval
