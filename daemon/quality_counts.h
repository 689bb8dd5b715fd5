#pragma once

#include "daemon/histogram.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Counts met and missed deadlines, and the frames of each level of the governor.
struct QualityCounts {
    std::string level;
    double deadlineMs = 0;  ///< 0: no deadline, because the level is pinned
    Histogram frameMs;
    std::uint64_t frames = 0, late = 0;
    std::vector<std::pair<std::string, std::uint64_t>> framesOf;

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
