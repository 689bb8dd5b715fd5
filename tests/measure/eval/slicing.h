#pragma once

#include "base/image_view.h"
#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <filesystem>

namespace mfar::eval {

struct SlicingRequest {
    Size size{320, 240};
    int samples = 64;
    int truthSamples = 512;
    double budgetMs = 4;
    int frames = 300;
    int threads = 2;            ///< number of threads for the row `budget` and for the truth
    std::filesystem::path svg;  ///< plot of error against time; empty: not written
    ProgressPart progress{};
};

/// Traces a picture of balls and boxes on a plane in time slices, in spatial slices, and as a
/// whole. Rows are named after the samples per pixel. Columns: ms of processor time; RMS error of
/// the picture before and after its noise is smoothed [grey levels of premultiplied RGBA inside the
/// objects' bounds].
///
/// Row `frames`: standard deviation, 95th percentile and maximum of the times of frames with
/// equally many samples, divided by the mean time. Row `budget`: `mean` and `deviation` of
/// BudgetKept. Throws EvalError if the plot cannot be written.
[[nodiscard]] Report evaluateSlicing(const SlicingRequest& request);

}  // namespace mfar::eval
