#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <cstdint>

namespace mfar {

/// Counts and results of EnlargerLearner. Gains of filters are measured in tiles to which no filter
/// was fitted, and the gain of guidance in tiles to which no guidance was fitted.
struct LearnerCounts {
    std::uint64_t stills = 0, repeated = 0, refused = 0;
    int classes = 0;     ///< number of classes with a learned filter, of enlarge::kUnique classes
    double gainDb = 0;   ///< gain of the filters in use over Keys' cubic [dB]
    double priorDb = 0;  ///< gain of the shipped filters over Keys' cubic [dB]
    std::uint64_t pairs = 0;  ///< pairs of stills from which guidance was learned
    Guidance guidance{};
    double guidanceGainDb = 0;  ///< gain of guidance over no guidance [dB]
    FineMatch fineMatch{};
};

}  // namespace mfar
