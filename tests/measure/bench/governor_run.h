#pragma once

#include "base/progress.h"
#include "daemon/quality_table.h"
#include "tests/measure/bench/clock.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace mfar::bench {

/// One scene of a sequence, as the governor handled it.
struct GovernedScene {
    std::string name;
    std::vector<double> ms;             ///< of its frames, from the first one after the change of
                                        ///< scene
    std::map<std::string, int> levels;  ///< number of frames at each level
};

struct GovernedRun {
    double deadlineMs = 0;
    std::vector<GovernedScene> scenes;
};

struct GovernorRequest {
    std::vector<double> deadlinesMs{33, 66, 133};
    int frames = 120;  ///< per scene
    Clock clock = Clock::Wall;
    ProgressPart progress{};  ///< what is shown while it runs
};

/// Runs the frames at one deadline after the other, each under its own governor that starts with
/// `levels`. Needs a current GL context.
[[nodiscard]] std::vector<GovernedRun> measureGovernor(const GovernorRequest& request,
                                                       const std::vector<QualityLevel>& levels);

/// Number of frames after a change of scene until at most one in twenty of the remaining ones is
/// late; all frames if that never happens.
[[nodiscard]] int settledAfter(std::span<const double> ms, double deadlineMs);

/// 95th percentile over the frames from number `from` (0: all) of each scene [ms].
[[nodiscard]] double p95(const GovernedRun& run, std::size_t from);

/// Human-readable: a line for each scene of each deadline.
[[nodiscard]] std::string governorTable(std::span<const GovernedRun> runs);
/// The time of each frame as lines, a chart for each deadline.
[[nodiscard]] std::string governorSvg(std::span<const GovernedRun> runs);

}  // namespace mfar::bench
