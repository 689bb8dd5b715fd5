#pragma once

#include "tests/measure/bench/clock.h"

#include <optional>
#include <string>
#include <vector>

namespace mfar::bench {

/// What leaving one kind of work out saves and costs in one case.
struct SkipResult {
    std::string skip, scene;  ///< the case
    double ms = 0,
           msWithout = 0;  ///< median frame with the skip, and with the work done all the same
    /// Errors that the skip adds; nothing where there is nothing to measure.
    std::optional<double> psnrLost;  ///< of the picture beside virtual objects [dB]
    /// Of the depth under them, where that decides what is seen [points].
    std::optional<double> bad1Added;
    std::optional<double>
        overlapLost;  ///< of where they are seen with where they should be [points]
};

/// A case with all skips on.
struct SkipCase {
    std::string scene;
    double ms = 0;          ///< median frame
    long depthTiles = 0;    ///< over all frames
    long framesInView = 0;  ///< with an object in view
    double changed = 0;     ///< mean share of the tiles
};

struct SkipReport {
    std::vector<SkipCase> cases;
    std::vector<SkipResult> results;
};

struct SkipRequest {
    std::vector<std::string> cases, skips;  ///< empty: all
    int frames = 20;                        ///< that count
    Clock clock = Clock::Wall;
};

[[nodiscard]] std::vector<std::string> skipNames();
[[nodiscard]] std::vector<std::string> skipCaseNames();

/// Runs every case with all skips on and with each of them off, frame by frame in turn. Needs a
/// current GL context.
[[nodiscard]] SkipReport measureSkips(const SkipRequest& request);

/// For people: cases, then skips; what saves nothing or costs more than 0.1 dB or points is marked.
[[nodiscard]] std::string skipTable(const SkipReport& report);
/// case,skip,ms,ms_without,saved_ms,psnr_lost_db,bad1_added,overlap_lost
[[nodiscard]] std::string skipCsv(const SkipReport& report);

}  // namespace mfar::bench
