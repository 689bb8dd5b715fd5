// mfar-faults runs mfard with schedules of faults until the time is over or mfard violates a rule.
#include "base/progress.h"
#include "tests/faults/plan.h"
#include "tests/faults/trial.h"
#include "tests/stability/seeded_run.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <ratio>
#include <sstream>
#include <string>

namespace {

using namespace mfar::faults;
using mfar::stress::SeededRun;
using mfar::stress::Tally;
using Clock = std::chrono::steady_clock;

struct Options {
    SeededRun run;
    bool twice = false;
    TrialOptions trial;
};

Options parse(int argc, char** argv) {
    Options o;
    CLI::App app("mfar-faults: runs mfard under random faults on a simulated clock and checks what "
                 "mfard promises");
    o.run.addOptions(app);
    app.add_option(
           "--episodes", o.trial.episodes,
           "number of episodes of one start of mfard, each with one or two faults (default 10)")
        ->check(CLI::PositiveNumber);
    app.add_option("--only", o.trial.only, "use only faults whose names contain this text");
    app.add_flag("--gpu", o.trial.hasGpu, "use OpenGL ES, which may fail, instead of SIMD");
    app.add_option("--soak", o.trial.soakFrames,
                   "inject no faults and end after this many pictures");
    app.add_flag("--twice", o.twice, "run each seed twice and compare both runs");
    app.add_option("--mfard", o.trial.program, "path of the program mfard")
        ->check(CLI::ExistingFile);
    mfar::stress::parseOrExit(app, argc, argv);
    if (o.trial.soakFrames > 0 && !o.run.seed) o.run.seed = 1;
    return o;
}

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

Tally drawSeeds(const Options& o, std::uint64_t seed) {
    const auto begin = Clock::now();
    mfar::Progress progress;
    Tally sum;
    for (bool more = true; more; ++seed) {
        // Only the first process shows its progress, because all processes end at the same time.
        const std::chrono::duration<double, std::ratio<60>> before = Clock::now() - begin;
        if (o.trial.job == 0)
            progress.show(o.run.seed ? std::nan("") : before.count() / o.run.minutes,
                          fmt::format("{} starts, {} episodes, {} failures in the first of {} "
                                      "processes",
                                      sum.seeds, sum.cases, sum.failures, o.run.jobs));
        const TrialResult result = runTrial(o.trial, seed);
        ++sum.seeds;
        if (const auto episodes = result.counts.find("episodes"); episodes != result.counts.end())
            sum.cases += episodes->second;
        for (const auto& [what, number] : result.counts)
            sum.inputs[what] += number;
        bool failed = !result.failure.empty();
        if (failed) {
            progress.clear();
            fmt::print("{}", result.failure);
        }
        if (!failed && o.twice) {
            const std::string again = runTrial(o.trial, seed).course;
            failed = again != result.course;
            if (failed)
                fmt::print("FAILED seed {}: the second run differs from the first\n{}", seed,
                           difference(result.course, again));
        }
        sum.failures += failed ? 1 : 0;
        std::fflush(stdout);
        const std::chrono::duration<double, std::ratio<60>> spent = Clock::now() - begin;
        more = o.run.goesOn(sum.seeds, spent.count(), sum.failures);
    }
    return sum;
}

}  // namespace

int main(int argc, char** argv) {
    const Options o = parse(argc, argv);
    try {
        static_cast<void>(Plan::drawn(1, 1, o.trial.only, o.trial.hasGpu));
        const auto begin = Clock::now();
        const Tally tally = o.run.run([&o](std::uint64_t first, int job) {
            Options own = o;
            own.trial.job = job;
            return drawSeeds(own, first);
        });
        print(tally, std::chrono::duration<double>(Clock::now() - begin).count());
        return tally.failures == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-faults: {}\n", error.what());
        return 2;
    }
}
