#include "daemon/repeat_limit.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

struct RepeatLimitTest : testing::Test {
    void happen(const std::string& event, const std::string& text) {
        if (limit.mayPass(event, {4, text}, now)) said.push_back(text);
    }
    void pass(milliseconds time) {
        now = now + time;
        for (const RepeatLimit::Message& one : limit.due(now))
            said.push_back(one.text);
    }

    Timestamp now = Timestamp::fromSeconds(1000);
    RepeatLimit limit;
    std::vector<std::string> said;
};

TEST_F(RepeatLimitTest, FirstEventIsLoggedAtOnceAndRepetitionsWithTheirCount) {
    for (int i = 0; i < 8; ++i)
        happen("plug", "gone");
    EXPECT_THAT(said, ElementsAre("gone"));
    pass(milliseconds(9900));
    EXPECT_THAT(said, ElementsAre("gone")) << "repetitions must not be logged before ten seconds";
    pass(milliseconds(100));
    EXPECT_THAT(said, ElementsAre("gone", "gone (repeated 7 times in 10 s)"));
    pass(seconds(100));
    EXPECT_EQ(said.size(), 2U) << "without a new event nothing may be logged";
    happen("plug", "gone");
    EXPECT_EQ(said.back(), "gone") << "an event long after the last one must be logged at once";
}

TEST_F(RepeatLimitTest, ASingleRepetitionIsLoggedAsRepeatedOnce) {
    happen("plug", "gone");
    happen("plug", "gone");
    pass(seconds(28));
    EXPECT_THAT(said, ElementsAre("gone", "gone (repeated once in 28 s)"));
}

// Without the limit, 16 lines would be logged in 28 s.
TEST_F(RepeatLimitTest, ALoosePlugCausesFewLinesAndTheLastLineIsCorrect) {
    for (int i = 0; i < 8; ++i) {
        happen("camera", "camera: gone");
        pass(milliseconds(1750));
        happen("back", "all devices are available again");
        pass(milliseconds(1750));
    }
    EXPECT_LE(said.size(), 6U);
    pass(seconds(10));
    EXPECT_THAT(said.back(), testing::StartsWith("all devices are available again"));
    EXPECT_LE(said.size(), 8U);
}

TEST_F(RepeatLimitTest, NewestTextOfAnEventIsKept) {
    happen("plug", "gone from /dev/video0");
    happen("plug", "gone from /dev/video2");
    happen("plug", "gone from /dev/video4");
    happen("disk", "full");
    EXPECT_THAT(said, ElementsAre("gone from /dev/video0", "full"))
        << "different events must be counted separately";
    pass(seconds(10));
    EXPECT_EQ(said.back(), "gone from /dev/video4 (repeated 2 times in 10 s)");
}

TEST_F(RepeatLimitTest, AStormOfEventsIsLoggedEveryTenSeconds) {
    for (int ms = 0; ms < 3'600'000; ms += 50) {
        happen("storm", "error");
        pass(milliseconds(50));
    }
    EXPECT_LE(said.size(), 361U);
    EXPECT_GE(said.size(), 300U);
}

TEST_F(RepeatLimitTest, AStormOfDifferentEventsCausesABoundedNumberOfLines) {
    for (int i = 0; i < 10'000; ++i)
        happen("event " + std::to_string(i), "error " + std::to_string(i));
    EXPECT_LE(said.size(), RepeatLimit::kMostEvents);
    pass(seconds(10));
    EXPECT_THAT(said.back(), testing::StartsWith("error 9999 ("));
    happen("another", "later");
    EXPECT_EQ(said.back(), "later") << "old events must be forgotten, so that a new one is logged";
}

TEST_F(RepeatLimitTest, ALongStormOfDifferentEventsIsLimitedInEveryPeriod) {
    int event = 0;
    for (int period = 0; period < 4; ++period) {
        const std::size_t before = said.size();
        for (int i = 0; i < 1000; ++i, ++event)
            happen("event " + std::to_string(event), "error");
        EXPECT_LE(said.size() - before, RepeatLimit::kMostEvents) << period;
        pass(seconds(10));
    }
}

TEST_F(RepeatLimitTest, PendingRepetitionsAreLoggedAtTheEnd) {
    happen("plug", "gone");
    happen("plug", "gone");
    happen("plug", "gone");
    now = now + seconds(3);
    const auto left = limit.rest(now);
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left.front().text, "gone (repeated 2 times in 3 s)");
    EXPECT_EQ(left.front().priority, 4);
    EXPECT_THAT(limit.rest(now), IsEmpty());
}

}  // namespace
}  // namespace mfar
