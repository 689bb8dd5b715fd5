#pragma once

#include "base/progress.h"
#include "tests/measure/bench/clock.h"

#include <optional>
#include <string>
#include <vector>

namespace mfar::bench {

struct SkipResult {
    std::string skip, scene;  ///< kind of skipped work, name of the case
    /// Median frame time with and without the skip.
    double ms = 0, msWithout = 0;
    /// Loss of accuracy by the skip. A value is empty if it cannot be measured.
    std::optional<double> psnrLost;  ///< PSNR of the picture outside virtual objects [dB]
    /// Added share of wrong depths among pixels whose depth decides if an object is visible
    /// [percentage points].
    std::optional<double> bad1Added;
    std::optional<double> overlapLost;  ///< overlap of shown and true object [percentage points]
};

/// Counters of a case with all skips enabled.
struct SkipCase {
    std::string scene;
    double ms = 0;
    long depthTiles = 0;  ///< sum over the frames of the tiles in which depth was searched
    long framesInView = 0;
    double changed = 0;
};

struct SkipReport {
    std::vector<SkipCase> cases;
    std::vector<SkipResult> results;
};

struct SkipRequest {
    std::vector<std::string> cases, skips;  ///< names to measure; empty: all
    int frames = 20;
    Clock clock = Clock::Wall;
    ProgressPart progress{};
};

[[nodiscard]] std::vector<std::string> skipNames();
[[nodiscard]] std::vector<std::string> skipCaseNames();

/// Runs every case with all skips enabled and with each skip disabled, in turn for each frame.
/// Needs a current GL context.
[[nodiscard]] SkipReport measureSkips(const SkipRequest& request);

/// Table of the cases and of the skips. Skips that lose more than 0.1 dB or 0.1 percentage points
/// are marked. A list tells in which cases each skip saves time.
[[nodiscard]] std::string skipTable(const SkipReport& report);
[[nodiscard]] std::string skipCsv(const SkipReport& report);
[[nodiscard]] std::string skipSvg(const SkipReport& report);

}  // namespace mfar::bench
