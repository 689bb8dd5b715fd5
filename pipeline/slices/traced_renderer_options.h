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
    /// A new scene with the same objects is ignored if lightChange() to the old scene is below this
    /// limit.
    double lightChange = 0.1;
    /// Processor time of all threads per call of update() [ms]; twice this time until the first
    /// picture is shown.
    double budgetMs = 4;
    int threads = 2;  ///< in [1, 64]
    /// Upper limit of hole requests' share of the processor time while a traced picture is
    /// incomplete, [0, 1].
    double holeShare = 0.5;
    std::size_t mostHolePixels = 20000;  ///< pixels per hole request
    bool operator==(const TracedRendererOptions&) const = default;
};

struct RenderCounters {
    Timestamp frame;
    std::uint64_t samples = 0;
    double samplesPerSecond = 0;  ///< mean over at least the last second, by frame time stamps
    double msPerSample = 0;
    double cpuMs = 0;  ///< processor time since the start, without work done once per scene
    BudgetKept budget;
    /// Number of finished pictures, in which no pixel needs more samples.
    std::uint64_t pictures = 0;
    std::uint64_t shown = 0;  ///< number of published pictures, fetched or not
    std::uint64_t holePixels = 0;
    double progress = 1;                  ///< finished share of the picture in progress, [0, 1]
    std::optional<Timestamp> shownSince;  ///< time at which the shown picture's view was chosen
    bool idle = true;         ///< true if there is no work until the view or the scene changes
    bool lowPriority = true;  ///< true if all threads could lower their priority
};

}  // namespace mfar
