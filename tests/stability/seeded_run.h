#pragma once

#include "tests/stability/processes.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace mfar::stress {

/// Options of a program that draws seeds: which seeds, for how long, in how many processes.
struct SeededRun {
    double minutes = 1;
    std::optional<std::uint64_t> seed;  ///< run only this seed
    std::uint64_t first = 0;            ///< first seed; 0: taken from the clock
    int rounds = 0;                     ///< number of seeds; 0: until the time is over
    int jobs = 1;
    bool keepGoing = false;

    void addOptions(CLI::App& app);
    [[nodiscard]] bool stops(long failures) const { return failures > 0 && !keepGoing; }
    /// True if another seed is to be run after `seeds` seeds and `spentMinutes` minutes in one
    /// process.
    [[nodiscard]] bool goesOn(long seeds, double spentMinutes, long failures) const;

    /// Runs seeds from `first` on, in process number `job`.
    using Draw = std::function<Tally(std::uint64_t first, int job)>;
    /// Runs a single seed in this process. Otherwise runs different seeds in each of several
    /// processes, see inProcesses().
    [[nodiscard]] Tally run(const Draw& draw) const;
};

/// Ends the program with status 0 after --help, and with status 2 if the options are invalid.
void parseOrExit(CLI::App& app, int argc, char** argv);

}  // namespace mfar::stress
