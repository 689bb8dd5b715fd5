#pragma once

#include "base/progress.h"
#include "tests/measure/bench/clock.h"

#include <optional>
#include <string>
#include <vector>

namespace mfar::bench {

/// The time that one skip saves in one case, and the accuracy that it costs.
struct SkipResult {
    std::string skip, scene;  ///< the kind of work that is skipped; the case
    double ms = 0,
           msWithout = 0;  ///< median frame [ms] with the skip, and without it
    /// Loss of accuracy by the skip: less PSNR, more depth errors, less overlap. A value is empty
    /// if it cannot be measured.
    std::optional<double> psnrLost;  ///< PSNR of the picture outside virtual objects [dB]
    /// Added share of wrong depths, among the pixels whose depth decides whether an object is
    /// visible [percentage points].
    std::optional<double> bad1Added;
    std::optional<double>
        overlapLost;  ///< less overlap of shown and true visible object [percentage points]
};

/// Counters of a case with all skips enabled.
struct SkipCase {
    std::string scene;
    double ms = 0;          ///< median frame time [ms]
    long depthTiles = 0;    ///< tiles in which depth was searched, sum over all frames
    long framesInView = 0;  ///< frames with an object in view
    double changed = 0;     ///< mean share of tiles that changed
};

struct SkipReport {
    std::vector<SkipCase> cases;
    std::vector<SkipResult> results;
};

struct SkipRequest {
    std::vector<std::string> cases, skips;  ///< names to measure; empty: all
    int frames = 20;                        ///< number of frames that are measured
    Clock clock = Clock::Wall;
    ProgressPart progress{};  ///< shows the progress while the command runs
};

[[nodiscard]] std::vector<std::string> skipNames();
[[nodiscard]] std::vector<std::string> skipCaseNames();

/// Runs every case with all skips enabled and with each skip disabled. Frames of these variants
/// alternate. Needs a current GL context.
[[nodiscard]] SkipReport measureSkips(const SkipRequest& request);

/// A text for people: the cases, then the skips. A skip that saves nothing, or that loses more than
/// 0.1 dB or 0.1 percentage points, is marked.
[[nodiscard]] std::string skipTable(const SkipReport& report);
/// Columns: case,skip,ms,ms_without,saved_ms,psnr_lost_db,bad1_added,overlap_lost.
[[nodiscard]] std::string skipCsv(const SkipReport& report);
/// Draws the time saved and the PSNR lost as bars, in two panels for each case.
[[nodiscard]] std::string skipSvg(const SkipReport& report);

}  // namespace mfar::bench
