#include "daemon/due_times.h"

#include <gtest/gtest.h>

#include <vector>

namespace mfar {
namespace {

/// Returns the times from 0 to 60 [s after `first`] at which isDue() returns true. The ticks are
/// `tick` [s] apart.
std::vector<double> dueTimes(double interval, double tick, double first = 100) {
    DueTimes due;
    std::vector<double> out;
    for (int i = 0; i * tick <= 60; ++i)
        if (due.isDue(first + i * tick, interval)) out.push_back(i * tick);
    return out;
}

TEST(DueTimes, AnIntervalThatIsAMultipleOfTheTickIsKeptExactly) {
    for (const double interval : {1.0, 10.0, 12.0, 15.0}) {
        const auto times = dueTimes(interval, 1);
        ASSERT_GT(times.size(), 3U);
        for (std::size_t i = 0; i < times.size(); ++i)
            EXPECT_EQ(times[i], static_cast<double>(i) * interval);
    }
}

TEST(DueTimes, AnyOtherIntervalIsKeptInTheMean) {
    EXPECT_EQ(dueTimes(1.5, 1).size(), 41U);
    EXPECT_EQ(dueTimes(1.2, 1).size(), 51U);
    EXPECT_EQ(dueTimes(0.1, 0.1).size(), 601U);
}

TEST(DueTimes, IntervalsMissedDuringAPauseAreSkipped) {
    DueTimes due;
    EXPECT_TRUE(due.isDue(1, 2));
    EXPECT_FALSE(due.isDue(2, 2));
    EXPECT_TRUE(due.isDue(50, 2));
    EXPECT_FALSE(due.isDue(51, 2));
    EXPECT_TRUE(due.isDue(52, 2));
}

TEST(DueTimes, AShorterIntervalTakesEffectAtOnce) {
    DueTimes due;
    EXPECT_TRUE(due.isDue(0, 3600));
    EXPECT_FALSE(due.isDue(1, 3600));
    EXPECT_FALSE(due.isDue(2, 3));
    EXPECT_TRUE(due.isDue(5, 3));
}

}  // namespace
}  // namespace mfar
