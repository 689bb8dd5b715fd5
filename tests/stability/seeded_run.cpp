#include "tests/stability/seeded_run.h"

#include "daemon/number_range.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace mfar::stress {

void SeededRun::addOptions(CLI::App& app) {
    jobs = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
    app.add_option("--minutes", minutes,
                   "number of minutes during which new seeds are run (default 1)")
        ->check(numberFrom(0, 1e6));
    app.add_option("--seed", seed, "run only this seed")->check(unsigned64());
    app.add_option("--first", first, "the first seed (default: taken from the clock)")
        ->check(unsigned64());
    app.add_option("--rounds", rounds, "end after this many seeds in each process")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--jobs", jobs,
                   "number of processes, each with its own seeds (default: one per core)")
        ->check(CLI::Range(1, 1024));
    app.add_flag("--keep-going", keepGoing, "continue after a failure");
}

bool SeededRun::goesOn(long seeds, double spentMinutes, long failures) const {
    return !seed && !stops(failures) && spentMinutes < minutes && (rounds == 0 || seeds < rounds);
}

Tally SeededRun::run(const Draw& draw) const {
    constexpr std::uint64_t kNextJob = 1000000000000;
    if (seed) return draw(*seed, 0);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now).count();
    const std::uint64_t begin = first != 0 ? first : static_cast<std::uint64_t>(seconds);
    return inProcesses(jobs, keepGoing, [&](int job) {
        return draw(begin + static_cast<std::uint64_t>(job) * kNextJob, job);
    });
}

void parseOrExit(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::exit(app.exit(error) == 0 ? 0 : 2);
    }
}

}  // namespace mfar::stress
