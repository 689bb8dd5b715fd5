#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <cstdint>

namespace mfar {

/// What EnlargerLearner has done so far.
struct LearnerCounts {
    std::uint64_t stills = 0, repeated = 0, refused = 0;
    int classes = 0;            ///< of enlarge::kUnique, whose filters in place are learned
    double gainDb = 0;          ///< of the set in place over the cubic, in the part held out
    double priorDb = 0;         ///< the same of the shipped filters
    std::uint64_t pairs = 0;    ///< of stills that guidance was learned from
    Guidance guidance{};        ///< FilterBank::guidance()
    double guidanceGainDb = 0;  ///< over none, in the part held out
    FineMatch fineMatch{};      ///< FilterBank::fineMatch()
};

}  // namespace mfar
