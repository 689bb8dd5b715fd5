#pragma once

#include "base/image_view.h"
#include "tests/measure/eval/report.h"

#include <filesystem>

namespace mfar::eval {

struct SlicingRequest {
    Size size{320, 240};
    int samples = 64;            ///< of a pixel of a finished picture
    int truthSamples = 512;      ///< of the picture it is compared with, of another seed
    double budgetMs = 4;         ///< of processor time, a frame
    int frames = 300;            ///< under the budget
    int threads = 2;             ///< for these frames and the truth; all else is timed on one
    std::filesystem::path plot;  ///< SVG of error against time; empty: none
};

/// A picture of a few balls and boxes on a plane by time slices, spatial slices and as a whole.
/// Columns: ms of processor time, and rmse [grey levels, premultiplied RGBA inside the objects'
/// bounds] of the picture as it is and with its noise smoothed, after so many samples a pixel (rows
/// are named after them); the frames' times for an equal share of the samples each, as a
/// coefficient of variation, 95th percentile and most by the mean (row `frames`); what the budget's
/// frames used of it in the mean and their 95th percentile of deviation (row `budget`). Throws
/// EvalError for a plot that cannot be written.
[[nodiscard]] Report evaluateSlicing(const SlicingRequest& request);

}  // namespace mfar::eval
