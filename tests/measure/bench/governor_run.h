#pragma once

#include "daemon/quality_table.h"
#include "tests/measure/bench/clock.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace mfar::bench {

/// One scene after the other, as the governor met it.
struct GovernedScene {
    std::string name;
    std::vector<double> ms;             ///< of its frames, from the first after the change of scene
    std::map<std::string, int> levels;  ///< frames of each
};

struct GovernedRun {
    double deadlineMs = 0;
    std::vector<GovernedScene> scenes;
};

struct GovernorRequest {
    std::vector<double> deadlinesMs{33, 66, 133};
    int frames = 120;  ///< of each scene
    Clock clock = Clock::Wall;
};

/// The frames of one deadline after the other, each under a governor of its own that starts with
/// `levels`. Needs a current GL context.
[[nodiscard]] std::vector<GovernedRun> measureGovernor(const GovernorRequest& request,
                                                       const std::vector<QualityLevel>& levels);

/// Frames from a change of scene on, until of those left no more than one in twenty are late; all
/// of them when that never is so.
[[nodiscard]] int settledAfter(std::span<const double> ms, double deadlineMs);

/// Of all frames, and of those from the 30th of each scene on [ms].
[[nodiscard]] double p95(const GovernedRun& run, std::size_t from);

/// For people: a line for each scene of each deadline.
[[nodiscard]] std::string governorTable(std::span<const GovernedRun> runs);

}  // namespace mfar::bench
