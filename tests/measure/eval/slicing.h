#pragma once

#include "base/image_view.h"
#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <filesystem>

namespace mfar::eval {

struct SlicingRequest {
    Size size{320, 240};
    int samples = 64;           ///< per pixel of a finished picture
    int truthSamples = 512;     ///< per pixel of the picture that it is compared with, with
                                ///< another seed
    double budgetMs = 4;        ///< processor time per frame
    int frames = 300;           ///< frames under the budget
    int threads = 2;            ///< for these frames and for the truth; everything else is timed
                                ///< on one thread
    std::filesystem::path svg;  ///< SVG of error against time; empty: not written
    ProgressPart progress{};    ///< what is shown while it runs
};

/// Measures a picture of a few balls and boxes on a plane by time slices, by spatial slices and as
/// a whole. Columns: ms of processor time, and rmse [grey levels, premultiplied RGBA inside the
/// objects' bounds] of the picture without and with smoothed noise, after some samples per pixel
/// (which name the rows); times of frames with equal shares of the samples: coefficient of
/// variation, 95th percentile and maximum over the mean (row `frames`); use of the budget by the
/// frames: mean, and 95th percentile of the deviation (row `budget`). Throws EvalError if the plot
/// cannot be written.
[[nodiscard]] Report evaluateSlicing(const SlicingRequest& request);

}  // namespace mfar::eval
