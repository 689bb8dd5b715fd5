#pragma once

#include "base/progress.h"
#include "daemon/quality_table.h"
#include "tests/measure/bench/clock.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace mfar::bench {

/// What the governor did during one scene of a sequence.
struct GovernedScene {
    std::string name;
    std::vector<double> ms;             ///< frame times, from the first frame of this scene on
    std::map<std::string, int> levels;  ///< number of frames at each quality level
};

struct GovernedRun {
    double deadlineMs = 0;
    std::vector<GovernedScene> scenes;
};

struct GovernorRequest {
    std::vector<double> deadlinesMs{33, 66, 133};
    int frames = 120;  ///< frames per scene
    Clock clock = Clock::Wall;
    ProgressPart progress{};  ///< shows the progress while the command runs
};

/// Runs the frames at one deadline after the other. Each deadline has its own governor, which
/// starts with the table `levels`. Needs a current GL context.
[[nodiscard]] std::vector<GovernedRun> measureGovernor(const GovernorRequest& request,
                                                       const std::vector<QualityLevel>& levels);

/// Number of frames that the governor needs to settle after a change of scene: from then on, at
/// most one frame in twenty is late. Equals the number of all frames if it never settles.
[[nodiscard]] int settledAfter(std::span<const double> ms, double deadlineMs);

/// 95th percentile of the frame times [ms]. The first `from` frames of each scene are not counted.
[[nodiscard]] double p95(const GovernedRun& run, std::size_t from);

/// A text for people: one line for each scene at each deadline.
[[nodiscard]] std::string governorTable(std::span<const GovernedRun> runs);
/// Draws the time of each frame as lines, in a chart for each deadline.
[[nodiscard]] std::string governorSvg(std::span<const GovernedRun> runs);

}  // namespace mfar::bench
