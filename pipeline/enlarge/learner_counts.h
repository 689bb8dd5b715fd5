#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <cstdint>

namespace mfar {

/// Counts and results of EnlargerLearner so far.
struct LearnerCounts {
    std::uint64_t stills = 0, repeated = 0, refused = 0;
    int classes = 0;            ///< of enlarge::kUnique, with learned filters in place
    double gainDb = 0;          ///< of the set in place over the cubic, in the held-out part
    double priorDb = 0;         ///< as above, for the shipped filters
    std::uint64_t pairs = 0;    ///< pairs of stills that guidance was learned from
    Guidance guidance{};        ///< FilterBank::guidance()
    double guidanceGainDb = 0;  ///< of the guidance over no guidance, in the held-out part
    FineMatch fineMatch{};      ///< FilterBank::fineMatch()
};

}  // namespace mfar
