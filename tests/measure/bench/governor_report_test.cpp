#include "tests/measure/bench/governor_run.h"

#include <gtest/gtest.h>

namespace mfar::bench {
namespace {

TEST(GovernorReport, SettledAfterCountsFramesUntilAtMostOneInTwentyIsLate) {
    std::vector<double> ms(100, 30);
    EXPECT_EQ(settledAfter(ms, 33), 0);
    ms[0] = ms[1] = ms[2] = 40;
    EXPECT_EQ(settledAfter(ms, 33), 0) << "3 of 100 frames are late";
    for (std::size_t i = 0; i < 12; ++i)
        ms[i] = 40;
    EXPECT_EQ(settledAfter(ms, 33), 8) << "4 of the last 92 frames are late";
    ms[99] = 40;
    EXPECT_EQ(settledAfter(ms, 33), 9);
}

TEST(GovernorReport, IfAllFramesAreLateSettledAfterReturnsTheirNumber) {
    const std::vector<double> ms(50, 40);
    EXPECT_EQ(settledAfter(ms, 33), 50);
    EXPECT_EQ(settledAfter({}, 33), 0);
}

TEST(GovernorReport, PercentileLeavesOutTheFirstFramesOfEachScene) {
    GovernedRun run{33, {{"a", std::vector<double>(60, 20), {}}, {"b", {}, {}}}};
    for (std::size_t i = 0; i < 30; ++i)
        run.scenes[0].ms[i] = 50;
    run.scenes[1].ms = {90, 90};
    EXPECT_DOUBLE_EQ(p95(run, 30), 20);
    EXPECT_DOUBLE_EQ(p95(run, 0), 50);
}

TEST(GovernorReport, TableNamesScenesAndLevels) {
    const GovernedRun run{66, {{"office", {50, 70}, {{"off", 1}, {"detail", 3}}}}};
    const std::string table = governorTable(std::span(&run, 1));
    EXPECT_NE(table.find("deadline 66 ms"), std::string::npos);
    EXPECT_NE(table.find("detail (3) off (1)"), std::string::npos) << table;
    EXPECT_EQ(table.find("without the first"), std::string::npos) << "no frame is left: " << table;
}

}  // namespace
}  // namespace mfar::bench
