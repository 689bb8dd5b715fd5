#pragma once

#include "pipeline/render/exposure.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/slices/budget_controller.h"
#include "pipeline/slices/slices.h"
#include "pipeline/slices/traced_pictures.h"
#include "pipeline/slices/view_predictor.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

struct TracedRendererOptions {
    SliceOptions slices;
    PathTracerOptions tracer;
    Exposure exposure;
    TracedPolicy policy;
    PredictionLimits prediction;
    /// A new scene with the same objects is ignored if lightChange() from the old one is smaller.
    double lightChange = 0.1;
    /// Processor time [ms] of all threads between two calls of update(); twice this time until the
    /// first picture is shown.
    double budgetMs = 4;
    int threads = 2;  ///< number of threads, [1, 64]
    /// While a traced picture is incomplete, tracing holes takes at most this share of the
    /// processor time, [0, 1].
    double holeShare = 0.5;
    std::size_t mostHolePixels = 20000;  ///< largest number of pixels in a hole request
    bool operator==(const TracedRendererOptions&) const = default;
};

struct RenderCounters {
    Timestamp frame;              ///< time of the newest frame
    std::uint64_t samples = 0;    ///< samples traced since the start
    double samplesPerSecond = 0;  ///< mean over at least one second of frame times
    double msPerSample = 0;       ///< processor time per sample
    double cpuMs = 0;             ///< processor time that belongs to the budget, since the start
    BudgetKept budget;
    /// Number of finished pictures: each pixel has a small error or all its samples.
    std::uint64_t pictures = 0;
    std::uint64_t shown = 0;       ///< published pictures, even if the reader did not fetch them
    std::uint64_t holePixels = 0;  ///< number of pixels that were rendered for hole requests
    double progress = 1;           ///< share of the picture in progress that is done, [0, 1]
    std::optional<Timestamp> shownSince;  ///< when the shown picture's view was chosen
    bool idle = true;                     ///< there is no work left while the camera rests
    bool lowPriority = true;              ///< all threads were allowed to lower their priority
};

}  // namespace mfar
