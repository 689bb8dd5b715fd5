#pragma once

#include "base/progress.h"
#include "tests/measure/bench/clock.h"

#include <optional>
#include <string>
#include <vector>

namespace mfar::bench {

struct SkipResult {
    /// Names of the skip (a type of work that the pipeline leaves out) and of the case.
    std::string skip, scene;
    /// Median frame time with and without the skip.
    double ms = 0, msWithout = 0;
    /// Loss of PSNR by the skip [dB], outside virtual objects. This value and the next two are
    /// empty if they cannot be measured.
    std::optional<double> psnrLost;
    /// Increase of DepthError::bad1, the share of wrong depths, by the skip [percentage points].
    /// Counts only pixels whose depth decides if an object is visible.
    std::optional<double> bad1Added;
    /// Loss of overlap between the shown and the true object by the skip [percentage points].
    std::optional<double> overlapLost;
};

/// Counters of a case with all skips enabled.
struct SkipCase {
    std::string scene;
    double ms = 0;
    long depthTiles = 0;    ///< number of tiles that need real depth, summed over the frames
    long framesInView = 0;  ///< number of frames with an object in view
    double redrawn = 0;     ///< mean share of tiles that were drawn again for any reason
};

struct SkipReport {
    std::vector<SkipCase> cases;
    std::vector<SkipResult> results;
};

struct SkipRequest {
    std::vector<std::string> cases, skips;  ///< names to measure; empty: all
    int frames = 20;
    bool quick = false;  ///< small pictures
    Clock clock = Clock::Wall;
    ProgressPart progress{};
};

[[nodiscard]] std::vector<std::string> skipNames();
[[nodiscard]] std::vector<std::string> skipCaseNames();

/// Measures every case in several variants. One variant has all skips enabled (a skip is a type of
/// work that the pipeline leaves out). For each skip, there is a variant in which only this skip is
/// disabled. Each frame is processed by all variants, one after the other. Needs a current GL
/// context.
[[nodiscard]] SkipReport measureSkips(const SkipRequest& request);

/// Table of the cases and of the skips. Skips that lose more than 0.1 dB or 0.1 percentage points
/// are marked. A list names the cases in which a skip saves more than 2 % of the time, and those in
/// which it loses more than these limits.
[[nodiscard]] std::string skipTable(const SkipReport& report);
[[nodiscard]] std::string skipCsv(const SkipReport& report);
[[nodiscard]] std::string skipSvg(const SkipReport& report);

}  // namespace mfar::bench
