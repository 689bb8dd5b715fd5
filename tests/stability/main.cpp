// mfar-stress: hostile cases with new seeds until the time is over or one of them fails.
#include "tests/stability/cases.h"
#include "tests/stability/precision.h"
#include "tests/stability/watched_shaders.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace mfar;
using namespace mfar::stress;
using Clock = std::chrono::steady_clock;

struct Options {
    double minutes = 1;
    std::optional<std::uint64_t> seed;
    std::uint64_t first = 0;
    int rounds = 0;
    std::vector<std::string> cases;
    int plant = -1;
    bool small = false, keepGoing = false, precision = false, listPlanted = false,
         listCases = false;
};

Options parse(int argc, char** argv) {
    Options o;
    CLI::App app("mfar-stress: runs every part of the pipeline on hostile input");
    app.add_option("--minutes", o.minutes, "how long new seeds are drawn (default 1)")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--seed", o.seed, "runs the cases with this seed alone");
    app.add_option("--first", o.first, "the first seed (default: by the clock)");
    app.add_option("--rounds", o.rounds, "ends after so many seeds");
    app.add_option("--case", o.cases, "these cases alone")->delimiter(',');
    app.add_option("--plant", o.plant, "plants a fault of --list-planted first");
    app.add_flag("--small", o.small, "small pictures alone, as in the tests");
    app.add_flag("--keep-going", o.keepGoing, "goes on after a failure");
    app.add_flag("--precision", o.precision, "prints the errors of single and half precision");
    app.add_flag("--list-planted", o.listPlanted, "prints the faults that can be planted");
    app.add_flag("--list-cases", o.listCases, "prints the names of the cases");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::exit(app.exit(error) == 0 ? 0 : 2);
    }
    return o;
}

std::vector<Case> chosen(const Options& o) {
    std::vector<Case> out;
    for (const Case& one : allCases())
        if (o.cases.empty() || std::ranges::find(o.cases, one.name) != o.cases.end())
            out.push_back(one);
    if (out.empty()) throw std::invalid_argument("no such case; see --list-cases");
    return out;
}

void printPixels(const Checks& checks) {
    fmt::print("{:<28} {:>16}\n", "pass", "pixels");
    for (const auto& [pass, pixels] : checks.pixels())
        fmt::print("{:<28} {:>16}\n", pass, pixels);
}

/// Seeds, cases, failures.
struct Totals {
    long seeds = 0, cases = 0, failures = 0;
};

void progress(const Totals& totals, std::uint64_t seed, double minutes) {
    fmt::print("{:6.1f} min, {} cases of {} seeds, the last {}, {} failures\n", minutes,
               totals.cases, totals.seeds, seed, totals.failures);
    std::fflush(stdout);
}

int drawSeeds(const Options& o) {
    GlWatch gl;
    Checks checks;
    const auto cases = chosen(o);
    const auto begin = Clock::now();
    const auto minutes = [&] {
        return std::chrono::duration<double>(Clock::now() - begin).count() / 60;
    };
    std::uint64_t seed = o.seed ? *o.seed : o.first;
    if (seed == 0)
        seed = static_cast<std::uint64_t>(
            std::chrono::system_clock::now().time_since_epoch().count() / 1000000000);
    Totals totals;
    double told = 0;
    for (bool more = true; more; ++seed) {
        for (const Case& one : cases) {
            const auto faults = run(one, seed, checks, gl, !o.small);
            ++totals.cases;
            for (const std::string& fault : faults)
                fmt::print("FAILED {}\n", fault);
            totals.failures += faults.empty() ? 0 : 1;
            if (!faults.empty())
                fmt::print("repeat: ./run stress --seed {} --case {}\n", seed, one.name);
            if (!faults.empty() && !o.keepGoing) break;
        }
        ++totals.seeds;
        more = !o.seed && minutes() < o.minutes && (o.rounds == 0 || totals.seeds < o.rounds) &&
               (totals.failures == 0 || o.keepGoing);
        if (minutes() < told && more) continue;
        told = minutes() + 0.25;
        progress(totals, seed, minutes());
    }
    printPixels(checks);
    return totals.failures == 0 ? 0 : 1;
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
        return drawSeeds(o);
    } catch (const std::exception& error) {
        fmt::print(stderr, "mfar-stress: {}\n", error.what());
        return 2;
    }
}
