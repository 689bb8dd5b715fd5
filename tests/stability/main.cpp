// mfar-stress runs hostile cases with new seeds until the time is over or a case fails.
#include "base/progress.h"
#include "tests/stability/balance.h"
#include "tests/stability/cases.h"
#include "tests/stability/precision.h"
#include "tests/stability/seeded_run.h"
#include "tests/stability/watched_shaders.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace mfar;
using namespace mfar::stress;
using Clock = std::chrono::steady_clock;

struct Options {
    SeededRun run;
    std::vector<std::string> cases;
    int plant = -1;
    long pixels = 100000000;
    bool small = false, full = false, precision = false, listPlanted = false, listCases = false;
};

Options parse(int argc, char** argv) {
    Options o;
    CLI::App app("mfar-stress: runs every part of the pipeline on extreme and invalid input");
    o.run.addOptions(app);
    app.add_option("--case", o.cases, "run only these cases")->delimiter(',');
    app.add_option("--plant", o.plant,
                   "plant a fault in a shader: the number of the fault, see --list-planted")
        ->check(CLI::Range(0, static_cast<int>(plantedFaults().size()) - 1));
    app.add_flag("--small", o.small, "use only small pictures, as in the tests");
    app.add_flag("--full", o.full, "use only pictures of mfard's usual size")->excludes("--small");
    app.add_option("--pixels", o.pixels,
                   "number of pixels that each pass should process (default 10^8); three "
                   "quarters of the time are used for this")
        ->check(CLI::NonNegativeNumber);
    app.add_flag("--precision", o.precision,
                 "print the errors that single and half precision cause");
    app.add_flag("--list-planted", o.listPlanted, "print the faults that can be planted");
    app.add_flag("--list-cases", o.listCases, "print the names of the cases");
    parseOrExit(app, argc, argv);
    return o;
}

std::vector<Case> chosen(const Options& o) {
    const std::vector<Case> all = allCases();
    for (const std::string& name : o.cases)
        if (std::ranges::find(all, name, &Case::name) == all.end())
            throw std::invalid_argument("unknown case " + name + "; see --list-cases");
    std::vector<Case> out;
    for (const Case& one : all)
        if (o.cases.empty() || std::ranges::find(o.cases, one.name) != o.cases.end())
            out.push_back(one);
    return out;
}

void print(const Tally& tally) {
    fmt::print("{:<28} {:>16}\n", "pass", "pixels");
    for (const auto& [pass, pixels] : tally.pixels)
        fmt::print("{:<28} {:>16}\n", pass, pixels);
    fmt::print("{:<28} {:>16}\n", "part", "inputs");
    for (const auto& [part, inputs] : tally.inputs)
        fmt::print("{:<28} {:>16}\n", part, inputs);
    fmt::print("{} cases of {} seeds, {} failures\n", tally.cases, tally.seeds, tally.failures);
}

class Run {
public:
    Run(const Options& options, int job)
        : options_(options), isFirst_(job == 0), cases_(chosen(options)), balance_(cases_) {}

    [[nodiscard]] Tally drawSeeds(std::uint64_t first);

private:
    [[nodiscard]] double minutes() const {
        return std::chrono::duration<double>(Clock::now() - begin_).count() / 60;
    }
    [[nodiscard]] bool stops() const { return options_.run.stops(failures_); }
    void runCase(const Case& one, std::uint64_t seed, Scale scale);
    void fillUp(std::uint64_t seed, double until);
    /// Only the first process shows its progress, because all processes end at the same time.
    void showProgress(const char* part);

    Options options_;
    bool isFirst_;
    Progress progress_;
    std::vector<Case> cases_;
    Balance balance_;
    GlWatch gl_;
    Checks checks_;
    Clock::time_point begin_ = Clock::now();
    long seeds_ = 0, ran_ = 0, failures_ = 0;
};

void Run::runCase(const Case& one, std::uint64_t seed, Scale scale) {
    showProgress(one.name);
    const auto before = checks_.pixels();
    const double start = minutes();
    const auto faults = run(one, seed, checks_, gl_, scale);
    balance_.ran(one, before, checks_.pixels(), 60 * (minutes() - start), scale);
    ++ran_;
    if (!faults.empty()) progress_.clear();
    for (const std::string& fault : faults)
        fmt::print("FAILED {}\n", fault);
    failures_ += faults.empty() ? 0 : 1;
    if (!faults.empty())
        fmt::print("repeat: ./run stress --seed {} --case {}{}\n", seed, one.name,
                   scale == Scale::Product ? " --full"
                   : scale == Scale::Tests ? " --small"
                                           : "");
}

// Runs the cases that balance_ chooses, until the time `until` [minutes] or until balance_ chooses
// none. Each run has its own seed, because a case may be chosen again.
void Run::fillUp(std::uint64_t seed, double until) {
    constexpr std::uint64_t kFarOff = 1000000007;
    while (!stops() && minutes() < until) {
        const Case* one = balance_.next(checks_, options_.pixels);
        if (one == nullptr) return;
        runCase(*one, seed, Scale::Product);
        seed += kFarOff;
    }
}

void Run::showProgress(const char* part) {
    if (!isFirst_) return;
    const double share = options_.run.seed ? std::nan("") : minutes() / options_.run.minutes;
    progress_.show(share, fmt::format("{0}; in the first of {4} processes: {1} cases, {2} seeds, "
                                      "{3} failures",
                                      part, ran_, seeds_, failures_, options_.run.jobs));
}

Tally Run::drawSeeds(std::uint64_t first) {
    std::uint64_t seed = first;
    const bool repeats = options_.run.seed.has_value();
    const Scale scale = options_.full    ? Scale::Product
                        : options_.small ? Scale::Tests
                                         : Scale::Mixed;
    for (bool more = true; more; ++seed) {
        const double start = minutes();
        for (const Case& one : cases_) {
            runCase(one, seed, scale);
            if (stops()) break;
        }
        // Runs cases at Scale::Product, for up to three times as long as the loop above took.
        if (scale == Scale::Mixed && !repeats)
            fillUp(seed, std::min(4 * minutes() - 3 * start, options_.run.minutes));
        ++seeds_;
        more = options_.run.goesOn(seeds_, minutes(), failures_);
    }
    progress_.clear();
    return {checks_.pixels(), checks_.inputs(), ran_, seeds_, failures_};
}

Tally runAll(Options o) {
    if (!o.run.seed) o.pixels /= o.run.jobs;
    return o.run.run([&o](std::uint64_t first, int job) { return Run(o, job).drawSeeds(first); });
}

int listPlanted() {
    int index = 0;
    for (const PlantedFault& fault : plantedFaults())
        fmt::print("{}\t{}\t{}\t{}\n", index++, fault.shader, fault.cases, fault.what);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const Options o = parse(argc, argv);
    try {
        if (o.listPlanted) return listPlanted();
        if (o.listCases) {
            for (const Case& one : allCases())
                fmt::print("{}\n", one.name);
            return 0;
        }
        if (o.plant >= 0) plant(plantedFaults()[static_cast<std::size_t>(o.plant)]);
        if (o.precision) {
            printPrecision();
            return 0;
        }
        const Tally tally = runAll(o);
        print(tally);
        return tally.failures == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-stress: {}\n", error.what());
        return 2;
    }
}
