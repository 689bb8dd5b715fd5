#pragma once

#include "daemon/histogram.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Counts of met and missed deadlines, and the levels used. `level` is empty without a governor.
struct QualityCounts {
    std::string level;      ///< of the latest frame
    double deadlineMs = 0;  ///< 0: the level is pinned
    Histogram frameMs;      ///< from the begin of a frame to its picture shown
    std::uint64_t frames = 0, late = 0;
    std::vector<std::pair<std::string, std::uint64_t>> framesOf;  ///< frames of each level

    [[nodiscard]] bool isLate(double ms) const { return deadlineMs > 0 && ms > deadlineMs; }

    void add(double ms) {
        frameMs.add(ms);
        ++frames;
        if (isLate(ms)) ++late;
        const auto known =
            std::ranges::find(framesOf, level, &std::pair<std::string, std::uint64_t>::first);
        if (known == framesOf.end())
            framesOf.emplace_back(level, 1);
        else
            ++known->second;
    }
};

}  // namespace mfar
