#pragma once

#include "base/progress.h"
#include "daemon/quality_table.h"
#include "tests/measure/bench/clock.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace mfar::bench {

struct GovernedScene {
    std::string name;
    std::vector<double> ms;
    std::map<std::string, int> levels;
};

struct GovernedRun {
    double deadlineMs = 0;
    std::vector<GovernedScene> scenes;
};

struct GovernorRequest {
    std::vector<double> deadlinesMs{33, 66, 133};
    int frames = 120;
    bool quick = false;  ///< small pictures
    Clock clock = Clock::Wall;
    ProgressPart progress{};
};

/// For each deadline, runs all scenes one after the other. Each deadline has its own governor,
/// which starts with the table `levels`. Needs a current GL context.
[[nodiscard]] std::vector<GovernedRun> measureGovernor(const GovernorRequest& request,
                                                       const std::vector<QualityLevel>& levels);

/// Number of frames after which the governor has settled: at most one in twenty of the remaining
/// frames takes longer than the deadline. If it never settles, returns the number of all frames.
[[nodiscard]] int settledAfter(std::span<const double> ms, double deadlineMs);

/// 95th percentile of the frame times [ms], without the first `from` frames of each scene.
[[nodiscard]] double p95(const GovernedRun& run, std::size_t from);

[[nodiscard]] std::string governorTable(std::span<const GovernedRun> runs);
[[nodiscard]] std::string governorSvg(std::span<const GovernedRun> runs);

}  // namespace mfar::bench
