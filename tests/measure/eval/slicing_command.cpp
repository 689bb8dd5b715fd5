#include "tests/measure/eval/slicing_command.h"

#include "tests/measure/eval/picture_options.h"

#include <cmath>
#include <string>

namespace mfar::eval {
namespace {

constexpr const char* kSlicingHelp =
    "Renders balls and boxes on a plane by time slices (time: a sample of every pixel, turn after\n"
    "turn), spatial slices (spatial: tile after tile with all samples) and as a whole (full).\n"
    "ms: processor time of one thread up to so many samples a pixel; rmse: against a picture of\n"
    "many samples [grey levels, premultiplied RGBA inside the bounds]; rmse_filtered: with the\n"
    "noise smoothed, as it is shown; of spatial slices nothing is seen where they have not been\n"
    "yet. -adaptive: calm pixels get no more samples.\n"
    "Row `frames`: a picture cut into 64 frames of equally many samples: ms of a frame in the\n"
    "mean; frame_cv: standard deviation, frame_p95: 95th percentile, frame_max: most, by the "
    "mean.\n"
    "Row `budget`: the renderer's threads under the budget while the view turns by 3 degrees a\n"
    "second: budget_mean: used by budget over all frames; budget_p95_off: 95th percentile of the\n"
    "frames' deviation from 1.";

}  // namespace

CLI::App* addSlicingCommand(CLI::App& app, SlicingRequest& request) {
    CLI::App* sub = app.add_subcommand("slicing", "time slices, spatial slices, full renderings");
    sub->footer(kSlicingHelp);
    addSize(*sub, request.size, "picture");
    sub->add_option("--samples", request.samples, "of a pixel of a finished picture")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--truth-samples", request.truthSamples, "of the picture compared with")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    sub->add_option("--budget", request.budgetMs, "of processor time a frame [ms]")
        ->check(isBudget)
        ->capture_default_str();
    sub->add_option("--frames", request.frames, "under the budget")
        ->check(CLI::Range(1, 300))
        ->capture_default_str();
    sub->add_option("--threads", request.threads, "for the frames under the budget")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    sub->add_option("--svg", request.svg, "file for a plot of error against time");
    return sub;
}

}  // namespace mfar::eval
