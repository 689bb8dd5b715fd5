#include "tests/stability/processes.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace mfar::stress {
namespace {

Tally tallyOf(int job) {
    Tally out;
    out.pixels = {{"a pass", 100 + job}, {job == 0 ? "first" : "second", 7}};
    out.inputs = {{"part", 3}};
    out.cases = 10;
    out.seeds = job + 1;
    return out;
}

TEST(StressProcesses, ResultsOfProcessesAreAddedUp) {
    const Tally sum = inProcesses(2, false, tallyOf);
    EXPECT_EQ(sum.pixels,
              (std::map<std::string, long>{{"a pass", 201}, {"first", 7}, {"second", 7}}));
    EXPECT_EQ(sum.inputs, (std::map<std::string, long>{{"part", 6}}));
    EXPECT_EQ(sum.cases, 20);
    EXPECT_EQ(sum.seeds, 3);
    EXPECT_EQ(sum.failures, 0);
}

TEST(StressProcesses, ACrashIsAFailureAndOtherResultsAreKept) {
    const Tally sum = inProcesses(2, true, [](int job) {
        if (job == 1) std::raise(SIGKILL);
        return tallyOf(job);
    });
    EXPECT_EQ(sum.failures, 1);
    EXPECT_EQ(sum.cases, 10);
}

TEST(StressProcesses, AFailureEndsTheOtherProcesses) {
    const auto begin = std::chrono::steady_clock::now();
    const Tally sum = inProcesses(2, false, [](int job) {
        if (job == 1) std::this_thread::sleep_for(std::chrono::minutes(1));
        Tally out = tallyOf(job);
        out.failures = 1;
        return out;
    });
    EXPECT_EQ(sum.failures, 1);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(StressProcesses, AnExceptionIsAFailure) {
    const Tally sum =
        inProcesses(1, false, [](int) -> Tally { throw std::runtime_error("broken"); });
    EXPECT_EQ(sum.failures, 1);
}

}  // namespace
}  // namespace mfar::stress
