#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <cstdint>

namespace mfar {

/// Counts and results of EnlargerLearner so far.
struct LearnerCounts {
    std::uint64_t stills = 0, repeated = 0, refused = 0;
    int classes = 0;            ///< classes with a learned filter in use, of enlarge::kUnique
    double gainDb = 0;          ///< of the filters in use over the cubic, held-out part [dB]
    double priorDb = 0;         ///< of the shipped filters over the cubic, held-out part [dB]
    std::uint64_t pairs = 0;    ///< pairs of stills that guidance was learned from
    Guidance guidance{};        ///< FilterBank::guidance()
    double guidanceGainDb = 0;  ///< gain of guidance over no guidance, in the held-out part [dB]
    FineMatch fineMatch{};      ///< FilterBank::fineMatch()
};

}  // namespace mfar
