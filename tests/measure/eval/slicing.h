#pragma once

#include "base/image_view.h"
#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <filesystem>

namespace mfar::eval {

struct SlicingRequest {
    Size size{320, 240};
    int samples = 64;           ///< samples per pixel of a finished picture
    int truthSamples = 512;     ///< samples per pixel of the truth, with another seed
    double budgetMs = 4;        ///< processor time per frame [ms]
    int frames = 300;           ///< number of frames under the budget
    int threads = 2;            ///< threads for `frames` and for the truth; else one
    std::filesystem::path svg;  ///< SVG of error against time; empty: not written
    ProgressPart progress{};    ///< shows the progress while the command runs
};

/// Traces a picture of a few balls and boxes on a plane in time slices, in spatial slices, and as a
/// whole. Rows are named after the samples per pixel. Columns: ms of processor time; rmse of the
/// picture, without and with smoothed noise [grey levels, premultiplied RGBA inside the objects'
/// bounds].
///
/// Row `frames`: times of frames with equal shares of the samples, as coefficient of variation, and
/// as 95th percentile and maximum over the mean. Row `budget`: use of the budget by the frames, as
/// mean, and as 95th percentile of the deviation. Throws EvalError if the plot cannot be written.
[[nodiscard]] Report evaluateSlicing(const SlicingRequest& request);

}  // namespace mfar::eval
