#pragma once

#include "tests/stability/processes.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace mfar::stress {

/// Options of a program that draws seeds: which seeds, how long, in how many processes.
struct SeededRun {
    double minutes = 1;
    std::optional<std::uint64_t> seed;  ///< only this one
    std::uint64_t first = 0;            ///< 0: from the clock
    int rounds = 0;                     ///< 0: until the time is over
    int jobs = 1;
    bool keepGoing = false;

    void addOptions(CLI::App& app);
    [[nodiscard]] bool stops(long failures) const { return failures > 0 && !keepGoing; }
    /// True when another seed is to be run, after this number of seeds and minutes in one process.
    [[nodiscard]] bool goesOn(long seeds, double spentMinutes, long failures) const;

    /// Draws seeds beginning with `first`, in process number `job`.
    using Draw = std::function<Tally(std::uint64_t first, int job)>;
    /// A single seed runs in this process. Otherwise as inProcesses(), with different seeds in
    /// each.
    [[nodiscard]] Tally run(const Draw& draw) const;
};

/// Ends the program with 0 after --help and with 2 when the options are invalid.
void parseOrExit(CLI::App& app, int argc, char** argv);

}  // namespace mfar::stress
