#pragma once

#include "pipeline/enlarge/filter_bank.h"

#include <cstdint>

namespace mfar {

/// Counts and results of EnlargerLearner so far.
struct LearnerCounts {
    std::uint64_t stills = 0, repeated = 0, refused = 0;
    int classes = 0;            ///< number of classes with a learned filter in use, out of
                                ///< enlarge::kUnique
    double gainDb = 0;          ///< gain of the filters in use over Keys' cubic, in held-out tiles
                                ///< [dB]
    double priorDb = 0;         ///< gain of the shipped filters over Keys' cubic, in held-out tiles
                                ///< [dB]
    std::uint64_t pairs = 0;    ///< number of pairs of stills that guidance was learned from
    Guidance guidance{};        ///< FilterBank::guidance()
    double guidanceGainDb = 0;  ///< gain of guidance over no guidance, in held-out tiles [dB]
    FineMatch fineMatch{};      ///< FilterBank::fineMatch()
};

}  // namespace mfar
