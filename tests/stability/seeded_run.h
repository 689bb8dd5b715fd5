#pragma once

#include "tests/stability/processes.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace mfar::stress {

struct SeededRun {
    double minutes = 1;
    std::optional<std::uint64_t> seed;
    std::uint64_t first = 0;  ///< first seed; 0: depends on the clock
    int rounds = 0;           ///< number of seeds of each process; 0: no limit but the time
    int jobs = 1;
    bool keepGoing = false;

    void addOptions(CLI::App& app);
    [[nodiscard]] bool stops(long failures) const { return failures > 0 && !keepGoing; }
    [[nodiscard]] bool goesOn(long seeds, double spentMinutes, long failures) const;

    using Draw = std::function<Tally(std::uint64_t first, int job)>;
    /// Runs a single seed in this process, or different seeds in several processes, see
    /// inProcesses().
    [[nodiscard]] Tally run(const Draw& draw) const;
};

/// Ends the program with status 0 after --help and with status 2 if the options are invalid.
void parseOrExit(CLI::App& app, int argc, char** argv);

}  // namespace mfar::stress
