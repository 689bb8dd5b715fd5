#pragma once

#include "tests/stability/processes.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace mfar::stress {

/// Which seeds a program draws, for how long and in how many processes.
struct SeededRun {
    double minutes = 1;
    std::optional<std::uint64_t> seed;  ///< this one alone
    std::uint64_t first = 0;            ///< 0: by the clock
    int rounds = 0;                     ///< 0: until the time is over
    int jobs = 1;
    bool keepGoing = false;

    void addOptions(CLI::App& app);
    [[nodiscard]] bool stops(long failures) const { return failures > 0 && !keepGoing; }
    /// Whether to run another seed after this many seeds and minutes in one process.
    [[nodiscard]] bool goesOn(long seeds, double spentMinutes, long failures) const;

    /// Draws seeds from the first on, in the process of this number.
    using Draw = std::function<Tally(std::uint64_t first, int job)>;
    /// In this process for a single seed. Otherwise as inProcesses(), with seeds that differ.
    [[nodiscard]] Tally run(const Draw& draw) const;
};

/// Ends the program with 0 after --help and with 2 when the options are invalid.
void parseOrExit(CLI::App& app, int argc, char** argv);

}  // namespace mfar::stress
