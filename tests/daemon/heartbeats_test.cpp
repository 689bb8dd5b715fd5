#include "base/heartbeats.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::IsEmpty;

struct HeartbeatsTest : testing::Test {
    [[nodiscard]] std::vector<std::string> late(int patience = 1) const {
        std::vector<std::string> names;
        for (const Heartbeats::Late& one : all.late(patience))
            names.push_back(one.thread);
        return names;
    }

    Timestamp now = Timestamp::fromSeconds(100);
    Heartbeats all{[this] { return now; }};
};

TEST_F(HeartbeatsTest, ThreadThatExceedsItsBudgetIsNamedWithTheTimeSinceItsLastBeat) {
    Heartbeat capture(all, "capture", seconds(1));
    Heartbeat picture(all, "picture", seconds(2));
    now = now + milliseconds(900);
    EXPECT_THAT(late(), IsEmpty());
    picture.beat();
    now = now + milliseconds(900);
    ASSERT_THAT(late(), ElementsAre("capture"));
    EXPECT_EQ(all.late().front().since, milliseconds(1800));
    EXPECT_EQ(all.late().front().role, ThreadRole::Vital);
    EXPECT_THAT(late(2), IsEmpty()) << "a patience of 2 must double the time budgets";
    capture.beat();
    EXPECT_THAT(late(), IsEmpty());
}

TEST_F(HeartbeatsTest, ThreadWithTheLongestSilenceComesFirst) {
    const Heartbeat first(all, "first", seconds(1));
    now = now + seconds(1);
    const Heartbeat second(all, "second", milliseconds(100), ThreadRole::Helper);
    now = now + seconds(1);
    EXPECT_THAT(late(), ElementsAre("first", "second"));
    EXPECT_EQ(all.late().back().role, ThreadRole::Helper);
}

TEST_F(HeartbeatsTest, ThreadThatWaitsForWorkIsNotLate) {
    Heartbeat control(all, "control", seconds(1));
    control.rest();
    now = now + seconds(1000);
    EXPECT_THAT(late(), IsEmpty());
    EXPECT_FALSE(all.waiting().has_value()) << "a wait without a name must not be reported";
    control.beat();
    EXPECT_THAT(late(), IsEmpty()) << "the time of waiting must not count";
    now = now + seconds(2);
    EXPECT_THAT(late(), ElementsAre("control"));
}

TEST_F(HeartbeatsTest, AWaitWithANameIsReportedButIsNoFault) {
    Heartbeat picture(all, "picture", seconds(1));
    picture.restFor("the reader of the pipe");
    now = now + seconds(5);
    EXPECT_THAT(late(), IsEmpty());
    ASSERT_TRUE(all.waiting().has_value());
    EXPECT_EQ(all.waiting()->what, "the reader of the pipe");
    EXPECT_EQ(all.waiting()->thread, "picture");
    EXPECT_EQ(all.waiting()->since, seconds(5));
    picture.beat();
    EXPECT_FALSE(all.waiting().has_value());
}

TEST_F(HeartbeatsTest, ThreadThatHasEndedIsNotWatched) {
    {
        const Heartbeat capture(all, "capture", seconds(1));
        now = now + seconds(5);
        EXPECT_THAT(late(), ElementsAre("capture"));
    }
    EXPECT_THAT(late(), IsEmpty());
}

}  // namespace
}  // namespace mfar
