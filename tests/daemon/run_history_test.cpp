#include "daemon/run_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mfar {
namespace {

Timestamp after(double seconds) {
    return Timestamp::fromSeconds(1000 + seconds);
}

std::uint64_t frames(const RunHistory& history) {
    std::uint64_t out = 0;
    for (const RunHistory::Bin& bin : history.bins())
        out += bin.frames;
    return out;
}

TEST(TimeSpread, QuantilesAreExactExceptForTheWidthOfABucket) {
    TimeSpread spread;
    for (int i = 1; i <= 1000; ++i)
        spread.add(0.1 * i);
    for (const double q : {0.1, 0.5, 0.95, 1.0})
        EXPECT_NEAR(spread.quantile(q) / (100 * q), 1, 0.05) << q;
}

TEST(TimeSpread, SumOfTwoSpreadsHasTheValuesOfBoth) {
    TimeSpread fast, slow;
    fast.add(1);
    slow.add(100);
    fast.add(slow);
    EXPECT_NEAR(fast.quantile(0.5), 1, 0.05);
    EXPECT_NEAR(fast.quantile(1), 100, 5);
}

TEST(TimeSpread, QuantilesOfAnEmptySpreadAreNan) {
    EXPECT_TRUE(std::isnan(TimeSpread{}.quantile(0.5)));
}

TEST(TimeSpread, AcceptsEveryValueThatADeviceMayReport) {
    TimeSpread spread;
    for (const double ms : {0.0, -1.0, 1e300, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()})
        spread.add(ms);
    EXPECT_TRUE(std::isfinite(spread.quantile(0.5)));
    EXPECT_TRUE(std::isfinite(spread.quantile(1)));
}

TEST(RunHistory, ABinHoldsTheFramesOfItsTimeSpan) {
    RunHistory history;
    RunTotals totals;
    totals.stillsUsed = 3;
    history.add({after(0), 10, 20, false, 0.5, {}}, {{"flow", 7}});
    history.add({after(0.25), 30, 40, true, {}, totals}, {{"flow", 9}, {"detail", 2}});
    ASSERT_EQ(history.bins().size(), 3U) << "times 0 and 0.25 s must give three bins of 0.1 s";
    EXPECT_EQ(history.stages(), (std::vector<std::string>{"flow", "detail"}));
    const RunHistory::Bin &first = history.bins()[0], &last = history.bins()[2];
    EXPECT_NEAR(first.frameMs.quantile(0.5), 10, 0.5);
    EXPECT_NEAR(first.latencyMs.quantile(0.5), 20, 1);
    EXPECT_EQ(first.confidenceSum, 0.5);
    EXPECT_EQ(first.late, 0U);
    EXPECT_EQ(history.bins()[1].frames, 0U);
    EXPECT_EQ(last.late, 1U);
    EXPECT_EQ(last.confidenceFrames, 0U);
    EXPECT_EQ(last.totals.stillsUsed, 3U);
    EXPECT_NEAR(last.stageMs[1].quantile(0.5), 2, 0.1);
}

TEST(RunHistory, ALongRunCountsEveryFrameInABoundedNumberOfBins) {
    RunHistory history;
    constexpr int kFrames = 200'000;
    for (int i = 0; i < kFrames; ++i) {
        RunMoment moment{after(10.0 * i), 20, 30, i % 10 == 0};
        moment.totals.stillsUsed = static_cast<std::uint64_t>(i);
        history.add(moment, {{"flow", i < kFrames / 2 ? 5.0 : 50.0}});
    }
    ASSERT_LE(history.bins().size(), RunHistory::kMostBins);
    ASSERT_GE(history.bins().size(), RunHistory::kMostBins / 2);
    EXPECT_EQ(frames(history), kFrames + 0U);
    EXPECT_NEAR(history.bins().front().stageMs[0].quantile(1), 5, 0.25);
    EXPECT_NEAR(history.bins().back().stageMs[0].quantile(0), 50, 2.5);
    EXPECT_EQ(history.bins().back().totals.stillsUsed, kFrames - 1U);
    const RunHistory::Bin& one = history.bins()[7];
    EXPECT_NEAR(static_cast<double>(one.late) / static_cast<double>(one.frames), 0.1, 0.01);
}

TEST(RunHistory, ALongPauseLeavesEmptyBins) {
    RunHistory history;
    history.add({after(0), 20, 30}, {});
    history.add({after(86400), 20, 30}, {});
    EXPECT_LE(history.bins().size(), RunHistory::kMostBins);
    EXPECT_EQ(history.bins().front().frames, 1U);
    EXPECT_EQ(history.bins()[history.bins().size() / 2].frames, 0U);
    EXPECT_EQ(history.bins().back().frames, 1U);
}

TEST(RunHistory, AFrameBeforeTheFirstTimeCountsForTheFirstBin) {
    RunHistory history;
    history.add({after(0), 20, 30}, {});
    history.add({after(-5), 20, 30}, {});
    ASSERT_EQ(history.bins().size(), 1U);
    EXPECT_EQ(history.bins()[0].frames, 2U);
}

TEST(RunHistory, BinsAreMergedUntilTheyHoldEnoughFramesEach) {
    RunHistory history;
    for (int i = 0; i < 40; ++i)
        history.add({after(0.5 * i), 20, 30}, {});
    history.fold(4);
    EXPECT_EQ(frames(history), 40U);
    EXPECT_LE(history.bins().size(), 10U);
    EXPECT_GE(history.bins().size(), 5U);
}

}  // namespace
}  // namespace mfar
