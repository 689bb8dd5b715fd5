#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/slices/slices.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A view of a scene, and what it looks like.
struct SlicedScene {
    std::shared_ptr<const PathTracer> tracer;
    RenderView view;
    PixelRect bounds;
    RenderedPicture truth;

    /// Of the few balls and boxes of the tests. `threads` trace the truth.
    SlicedScene(Size size, int truthSamples, int threads);
    /// Root mean square of the difference to the truth inside the bounds [grey levels].
    [[nodiscard]] double error(const Film& film, bool filter = false) const;
};

/// After so much processor time the picture was so far off.
struct ErrorAt {
    double samples = 0;  ///< of a pixel in the mean
    double ms = 0, rmse = 0;
    double filtered = 0;  ///< rmse of the picture whose noise is smoothed
};

/// The picture on its way: after 1, 2, 4, ... samples (time slices), after 1, 2, 4, ... of 16 parts
/// of it and at the end (spatial slices), where nothing is seen yet of what is not traced.
[[nodiscard]] std::vector<ErrorAt> slicedErrors(const SlicedScene& scene,
                                                const SliceOptions& slices);

/// The picture as a whole, anew with 1, 2, 4, ... samples up to `samples`.
[[nodiscard]] std::vector<ErrorAt> wholeErrors(const SlicedScene& scene, int samples);

/// Processor time of each frame [ms] when a picture is cut into `frames` of equally many samples.
[[nodiscard]] std::vector<double> frameTimes(const SlicedScene& scene, const SliceOptions& slices,
                                             int frames);

/// How `frames` frames kept to a budget: the product's renderer in its threads, while the view
/// turns by `degreesPerSecond` at 30 frames a second, which makes new pictures necessary.
struct BudgetRun {
    double mean = 0, deviation = 0;  ///< as of BudgetKept
    double samplesPerSecond = 0;     ///< of processor time
};
[[nodiscard]] BudgetRun budgetRun(const SliceOptions& slices, Size size, double budgetMs,
                                  int threads, int frames, double degreesPerSecond);

}  // namespace mfar::eval
