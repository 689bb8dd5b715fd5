#include "daemon/trigger_reports.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TriggerReports, EachEventIsReportedOnce) {
    TriggerReports reports;
    EXPECT_THAT(reports.newSince({}), IsEmpty());
    EXPECT_THAT(
        reports.newSince({1, 0, true}),
        ElementsAre("no still arrived after a trigger pulse; the still is requested again"));
    EXPECT_THAT(reports.newSince({1, 0, false}), IsEmpty());
    EXPECT_THAT(reports.newSince({1, 2, false}),
                ElementsAre("the loopback input missed an edge of a trigger pulse, so the time of "
                            "the still's exposure was not measured"));
    EXPECT_THAT(reports.newSince({2, 2, false}),
                ElementsAre("no still arrived after a trigger pulse"));
    EXPECT_THAT(reports.newSince({2, 2, false}), IsEmpty());
}

// The counters of a newly opened device start at zero.
TEST(TriggerReports, CounterResetsAreNotEvents) {
    TriggerReports reports;
    (void)reports.newSince({5, 5, false});
    EXPECT_THAT(reports.newSince({0, 0, false}), IsEmpty());
    EXPECT_EQ(reports.newSince({1, 1, false}).size(), 2U);
}

}  // namespace
}  // namespace mfar
