#pragma once

#include "base/progress.h"
#include "tests/measure/bench/clock.h"

#include <optional>
#include <string>
#include <vector>

namespace mfar::bench {

/// Time saved and accuracy lost by skipping one kind of work in one case.
struct SkipResult {
    std::string skip, scene;  ///< the case
    double ms = 0,
           msWithout = 0;  ///< median frame with the skip, and without it
    /// Errors that the skip adds; empty if there is nothing to measure.
    std::optional<double> psnrLost;  ///< of the picture outside virtual objects [dB]
    /// Error of the depth under the objects, where it decides visibility [points].
    std::optional<double> bad1Added;
    std::optional<double>
        overlapLost;  ///< overlap of the visible object with its true visible part [points]
};

/// A case with all skips enabled.
struct SkipCase {
    std::string scene;
    double ms = 0;          ///< median frame
    long depthTiles = 0;    ///< over all frames
    long framesInView = 0;  ///< frames with an object in view
    double changed = 0;     ///< mean share of the tiles
};

struct SkipReport {
    std::vector<SkipCase> cases;
    std::vector<SkipResult> results;
};

struct SkipRequest {
    std::vector<std::string> cases, skips;  ///< empty: all
    int frames = 20;                        ///< number of frames that count
    Clock clock = Clock::Wall;
    ProgressPart progress{};  ///< what is shown while it runs
};

[[nodiscard]] std::vector<std::string> skipNames();
[[nodiscard]] std::vector<std::string> skipCaseNames();

/// Runs every case with all skips enabled, and with each of them disabled, frame by frame in turn.
/// Needs a current GL context.
[[nodiscard]] SkipReport measureSkips(const SkipRequest& request);

/// Human-readable: cases, then skips; skips that save nothing, or lose more than 0.1 dB or points,
/// are marked.
[[nodiscard]] std::string skipTable(const SkipReport& report);
/// case,skip,ms,ms_without,saved_ms,psnr_lost_db,bad1_added,overlap_lost
[[nodiscard]] std::string skipCsv(const SkipReport& report);
/// Time saved and PSNR lost as bars, two panels for each case.
[[nodiscard]] std::string skipSvg(const SkipReport& report);

}  // namespace mfar::bench
