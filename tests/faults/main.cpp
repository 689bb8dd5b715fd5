// mfar-faults: mfard under schedules of faults until the time is over or one of its promises
// breaks.
#include "tests/faults/plan.h"
#include "tests/faults/trial.h"
#include "tests/stability/processes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

namespace {

using namespace mfar::faults;
using mfar::stress::Tally;
using Clock = std::chrono::steady_clock;

struct Options {
    double minutes = 1;
    std::optional<std::uint64_t> seed;
    std::uint64_t first = 0;
    int rounds = 0;
    int jobs = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
    bool keepGoing = false, twice = false;
    TrialOptions trial;
};

Options parse(int argc, char** argv) {
    Options o;
    CLI::App app("mfar-faults: mfard under schedules of faults, on a simulated clock");
    app.add_option("--minutes", o.minutes, "how long new seeds are drawn (default 1)")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--seed", o.seed, "runs the schedule of this seed alone");
    app.add_option("--first", o.first, "the first seed (default: by the clock)");
    app.add_option("--rounds", o.rounds, "ends after so many seeds in each process");
    app.add_option("--episodes", o.trial.episodes,
                   "of one start of mfard, each with one or two faults (default 10)")
        ->check(CLI::PositiveNumber);
    app.add_option("--only", o.trial.only, "of faults whose names contain this");
    app.add_option("--soak", o.trial.soakFrames, "no faults; ends after so many pictures");
    app.add_option("--jobs", o.jobs, "processes, each with seeds of its own (default: one a core)")
        ->check(CLI::Range(1, 1024));
    app.add_flag("--keep-going", o.keepGoing, "goes on after a failure");
    app.add_flag("--twice", o.twice, "runs each seed twice, and compares");
    app.add_option("--mfard", o.trial.program, "the program")->check(CLI::ExistingFile);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::exit(app.exit(error) == 0 ? 0 : 2);
    }
    return o;
}

/// The first line in which two reports differ.
std::string difference(const std::string& one, const std::string& other) {
    std::istringstream first(one), second(other);
    std::string a, b;
    while (a == b && (first || second)) {
        if (!std::getline(first, a)) a.clear();
        if (!std::getline(second, b)) b.clear();
    }
    return fmt::format("  first:  {}\n  second: {}\n", a, b);
}

void print(const Tally& tally, double seconds) {
    for (const auto& [what, number] : tally.inputs)
        fmt::print("{:<28} {:>12}\n", what, number);
    fmt::print("{} starts, {} episodes of faults in {:.1f} s, {} failures\n", tally.seeds,
               tally.cases, seconds, tally.failures);
}

/// Runs one seed after the other.
Tally drawSeeds(const Options& o, std::uint64_t seed) {
    const auto begin = Clock::now();
    Tally sum;
    for (bool more = true; more; ++seed) {
        const TrialResult result = runTrial(o.trial, seed);
        ++sum.seeds;
        if (const auto episodes = result.counts.find("episodes"); episodes != result.counts.end())
            sum.cases += episodes->second;
        for (const auto& [what, number] : result.counts)
            sum.inputs[what] += number;
        bool failed = !result.failure.empty();
        if (failed) fmt::print("{}", result.failure);
        if (!failed && o.twice) {
            const std::string again = runTrial(o.trial, seed).course;
            failed = again != result.course;
            if (failed)
                fmt::print("FAILED seed {}: the second run took another course\n{}", seed,
                           difference(result.course, again));
        }
        sum.failures += failed ? 1 : 0;
        std::fflush(stdout);
        const std::chrono::duration<double> spent = Clock::now() - begin;
        more = !o.seed && o.trial.soakFrames == 0 && (!failed || o.keepGoing) &&
               spent.count() < 60 * o.minutes && (o.rounds == 0 || sum.seeds < o.rounds);
    }
    return sum;
}

Tally runAll(const Options& o) {
    constexpr std::uint64_t kNextJob = 1000000000000;
    if (o.seed || o.trial.soakFrames > 0) return drawSeeds(o, o.seed.value_or(1));
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const std::uint64_t first =
        o.first != 0 ? o.first
                     : static_cast<std::uint64_t>(
                           std::chrono::duration_cast<std::chrono::seconds>(now).count());
    return mfar::stress::inProcesses(o.jobs, o.keepGoing, [&](int job) {
        Options own = o;
        own.trial.job = job;
        return drawSeeds(own, first + static_cast<std::uint64_t>(job) * kNextJob);
    });
}

}  // namespace

int main(int argc, char** argv) {
    const Options o = parse(argc, argv);
    try {
        static_cast<void>(Plan::drawn(1, 1, o.trial.only));
        const auto begin = Clock::now();
        const Tally tally = runAll(o);
        print(tally, std::chrono::duration<double>(Clock::now() - begin).count());
        return tally.failures == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-faults: {}\n", error.what());
        return 2;
    }
}
