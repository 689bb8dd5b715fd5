#include "tests/measure/eval/slicing_command.h"

#include "tests/measure/eval/picture_options.h"

#include <cmath>
#include <string>

namespace mfar::eval {
namespace {

constexpr const char* kSlicingHelp =
    "Renders balls and boxes on a plane by time slices (time: one sample of every pixel,\n"
    "again and again), by spatial slices (spatial: tile after tile with all samples) and as a\n"
    "whole (full).\n"
    "ms: processor time of one thread up to this number of samples per pixel; rmse: error\n"
    "against a picture of many samples [grey levels, premultiplied RGBA inside the bounds];\n"
    "rmse_filtered: the same with the noise smoothed, as it is shown; spatial slices show\n"
    "nothing in tiles that are not rendered yet. -adaptive: pixels with little noise get no\n"
    "more samples.\n"
    "Row `frames`: a picture cut into 64 frames of equally many samples. ms: mean of a frame;\n"
    "frame_cv, frame_p95, frame_max: standard deviation, 95th percentile and maximum, divided\n"
    "by the mean.\n"
    "Row `budget`: the renderer's threads under the budget while the view turns by 3 degrees\n"
    "a second: budget_mean: used time divided by the budget, over all frames; budget_p95_off:\n"
    "95th percentile of the deviation of a frame's quotient from 1.";

}  // namespace

CLI::App* addSlicingCommand(CLI::App& app, SlicingRequest& request) {
    CLI::App* sub =
        app.add_subcommand("slicing", "compare time slices, spatial slices and full renderings");
    sub->footer(kSlicingHelp);
    addSize(*sub, request.size, "picture");
    sub->add_option("--samples", request.samples, "samples per pixel of a finished picture")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--truth-samples", request.truthSamples, "samples per pixel of the truth")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--budget", request.budgetMs, "budget of processor time per frame [ms]")
        ->check(isBudget)
        ->capture_default_str();
    sub->add_option("--frames", request.frames,
                    "number of frames that are rendered under the budget")
        ->check(CLI::Range(1, 300))
        ->capture_default_str();
    sub->add_option("--threads", request.threads,
                    "number of threads for the frames under the budget")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    sub->add_option("--svg", request.svg, "file to write a plot of error against time into");
    return sub;
}

}  // namespace mfar::eval
