#pragma once

#include "pipeline/render/exposure.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/slices/budget_controller.h"
#include "pipeline/slices/reference_pictures.h"
#include "pipeline/slices/slices.h"
#include "pipeline/slices/view_predictor.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace mfar {

struct ReferenceOptions {
    SliceOptions slices;
    PathTracerOptions tracer;
    Exposure exposure;
    ReferencePolicy policy;
    PredictionLimits prediction;
    double lightChange = 0.1;  ///< see lightChange(): new light that differs less is ignored
    double budgetMs = 4;       ///< processor time of all threads between two calls of update()
    int threads = 2;           ///< [1, 64]
    double holeShare = 0.5;    ///< upper limit of the share of the time for holes while a reference
                               ///< waits, [0, 1]
    std::size_t mostHolePixels = 20000;  ///< per request
    bool operator==(const ReferenceOptions&) const = default;
};

struct RenderCounters {
    Timestamp frame;              ///< the last one received
    std::uint64_t samples = 0;    ///< traced since the start
    double samplesPerSecond = 0;  ///< over the last second or more of frame times
    double msPerSample = 0;       ///< processor time
    double cpuMs = 0;             ///< within the budget, since the start
    BudgetKept budget;
    std::uint64_t pictures = 0;    ///< finished: every pixel has a small error or all its samples
    std::uint64_t shown = 0;       ///< published, whether or not the reader saw them
    std::uint64_t holePixels = 0;  ///< answered
    double progress = 1;           ///< of the picture in progress, [0, 1]
    std::optional<Timestamp> referenceSince;  ///< when the view of the picture shown was chosen
    bool idle = true;                         ///< nothing to do while the camera rests
    bool lowPriority = true;                  ///< every thread was allowed to lower its priority
};

}  // namespace mfar
