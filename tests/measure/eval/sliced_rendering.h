#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/slices/slices.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A view of a scene, and its true picture.
struct SlicedScene {
    std::shared_ptr<const PathTracer> tracer;
    RenderView view;
    PixelRect bounds;
    RenderedPicture truth;

    /// The small test scene of balls and boxes. `threads`: number of threads that trace the truth.
    SlicedScene(Size size, int truthSamples, int threads);
    /// Root mean square error of `film` inside the objects' bounds [grey levels]. `filter`: smooth
    /// the noise first.
    [[nodiscard]] double error(const Film& film, bool filter = false) const;
};

/// Error of a picture after some processor time.
struct ErrorAt {
    double samples = 0;  ///< mean number of samples per pixel
    double ms = 0, rmse = 0;
    double filtered = 0;  ///< error of the picture after its noise was smoothed
};

/// Errors of the unfinished picture. Time slices: after 1, 2, 4, ... samples. Spatial slices: after
/// 1, 2, 4, ... of its 16 parts, and at the end; parts that are not traced yet are empty.
[[nodiscard]] std::vector<ErrorAt> slicedErrors(const SlicedScene& scene,
                                                const SliceOptions& slices);

/// Errors of the whole picture, each traced from scratch, with 1, 2, 4, ... samples up to
/// `samples`.
[[nodiscard]] std::vector<ErrorAt> wholeErrors(const SlicedScene& scene, int samples);

/// Processor time of each frame [ms] if a picture is divided into `frames` portions with equal
/// numbers of samples.
[[nodiscard]] std::vector<double> frameTimes(const SlicedScene& scene, const SliceOptions& slices,
                                             int frames);

/// How well the frames kept to the budget. The product's renderer works in its threads for `frames`
/// frames. Meanwhile the view rotates by `degreesPerSecond` at 30 frames per second, so that new
/// pictures are needed.
struct BudgetRun {
    double mean = 0, deviation = 0;  ///< see BudgetKept
    double samplesPerSecond = 0;     ///< per second of processor time
};
[[nodiscard]] BudgetRun budgetRun(const SliceOptions& slices, Size size, double budgetMs,
                                  int threads, int frames, double degreesPerSecond);

}  // namespace mfar::eval
