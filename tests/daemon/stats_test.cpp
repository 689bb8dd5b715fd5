#include "daemon/stats.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace mfar {
namespace {

TEST(Stats, CountersOfSeveralPathTracersAreAddedUp) {
    Stats stats;
    TracedLayerCounters counters;
    for (const double cpuMs : {100., 300., 50., 80.}) {
        counters.render.cpuMs = cpuMs;
        counters.render.samples = static_cast<std::uint64_t>(10 * cpuMs);
        stats.traced(counters, {});
    }
    const std::optional<TracedLayerCounters> all = stats.count().traced;
    ASSERT_TRUE(all);
    EXPECT_EQ(all->render.cpuMs, 380);
    EXPECT_EQ(all->render.samples, 3800U);
}

TEST(Stats, AStillThatArrivesAfterItsTimeoutIsNotLost) {
    Stats stats;
    const auto at = [](double s) { return Timestamp::fromSeconds(s); };
    stats.triggers(1, 0, at(1));
    EXPECT_EQ(stats.count().stills.lost, 0U);
    stats.triggers(2, 1, at(4));
    EXPECT_EQ(stats.count().stills.lost, 1U);
    stats.stillReceived(at(1.1));
    EXPECT_EQ(stats.count().stills.lost, 0U) << "the first pulse's still arrived late";
    stats.triggers(2, 2, std::nullopt);
    EXPECT_EQ(stats.count().stills.lost, 1U);
    stats.triggers(3, 2, at(8));
    EXPECT_EQ(stats.count().stills.lost, 1U) << "the third pulse's still is awaited";
    stats.stillReceived(at(8.1));
    stats.triggers(3, 2, std::nullopt);
    EXPECT_EQ(stats.count().stills.received + stats.count().stills.lost, 3U);
}

// Regression test: between the arrival of a still and the frame that has it, the still counted as
// received and as awaited, so a lost still of an earlier pulse did not count.
TEST(Stats, ALostPulseStaysLostWhenTheAwaitedStillArrives) {
    Stats stats;
    stats.triggers(2, 1, Timestamp::fromSeconds(4));
    ASSERT_EQ(stats.count().stills.lost, 1U);
    stats.stillReceived(Timestamp::fromSeconds(4.1));
    EXPECT_EQ(stats.count().stills.lost, 1U);
    stats.triggers(2, 1, std::nullopt);
    EXPECT_EQ(stats.count().stills.lost, 1U);
}

TEST(Stats, ACameraThatIsBeingOpenedIsNoFault) {
    Stats stats;
    stats.fault("video camera is being opened");
    stats.fault({});
    EXPECT_EQ(stats.count().faults, 0U);
    stats.fault("still camera is missing");
    std::this_thread::sleep_for(std::chrono::milliseconds(550));
    stats.fault("still camera is missing");
    EXPECT_EQ(stats.count().faults, 1U)
        << "a camera that is missing for more than 0.5 s is a fault";
    stats.fault({});
    const std::vector<StageTime> stages;
    stats.picture({{}, stages, {}, {}, {}});
    stats.fault("video camera was lost");
    stats.fault("video camera was lost");
    stats.fault({});
    EXPECT_EQ(stats.count().faults, 2U);
    stats.fault("video camera was lost");
    EXPECT_EQ(stats.count().faults, 3U);
}

}  // namespace
}  // namespace mfar
