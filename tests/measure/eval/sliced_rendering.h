#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/slices/slices.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mfar::eval {

struct SlicedScene {
    std::shared_ptr<const PathTracer> tracer;
    RenderView view;
    PixelRect bounds;
    RenderedPicture truth;

    SlicedScene(Size size, int truthSamples, int threads);
    /// RMS error of `film` inside the objects' bounds [grey levels]. `filter`: smooths the noise
    /// first.
    [[nodiscard]] double error(const Film& film, bool filter = false) const;
};

struct ErrorAt {
    double samples = 0;
    double ms = 0, rmse = 0;
    double filtered = 0;  ///< RMS error after the noise was smoothed
};

/// Errors of the unfinished picture and, at the end, of the finished one. With time slices, they
/// are measured after 1, 2, 4, ... samples per pixel. With spatial slices, they are measured after
/// 1, 2, 4, ... sixteenths of the picture; pixels that have not been traced yet are empty.
[[nodiscard]] std::vector<ErrorAt> slicedErrors(const SlicedScene& scene,
                                                const SliceOptions& slices);

/// Errors of whole pictures that were traced anew with 1, 2, 4, ... samples per pixel, at most
/// `samples`.
[[nodiscard]] std::vector<ErrorAt> wholeErrors(const SlicedScene& scene, int samples);

/// Processor time of each frame [ms] if a picture is divided into `frames` portions of equally many
/// samples.
[[nodiscard]] std::vector<double> frameTimes(const SlicedScene& scene, const SliceOptions& slices,
                                             int frames);

/// Result of budgetRun(), which lets mfard's renderer work in its threads, at 30 frames per second,
/// until BudgetKept counts `frames` frames, for at most 4 * frames + 60 frames. The view rotates by
/// `degreesPerSecond`, so new pictures are needed.
struct BudgetRun {
    double mean = 0, deviation = 0;  ///< see BudgetKept
    double samplesPerSecond = 0;     ///< samples per second of processor time
};
[[nodiscard]] BudgetRun budgetRun(const SliceOptions& slices, Size size, double budgetMs,
                                  int threads, int frames, double degreesPerSecond);

}  // namespace mfar::eval
