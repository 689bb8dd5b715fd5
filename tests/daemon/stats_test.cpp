#include "daemon/stats.h"

#include <gtest/gtest.h>

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

TEST(Stats, ACameraThatIsBeingOpenedIsNoFault) {
    Stats stats;
    stats.fault("video camera is being opened");
    stats.fault({});
    EXPECT_EQ(stats.count().faults, 0U);
    const std::vector<StageTime> stages;
    stats.picture({{}, stages, {}, {}, {}});
    stats.fault("video camera was lost");
    stats.fault("video camera was lost");
    stats.fault({});
    EXPECT_EQ(stats.count().faults, 1U);
    stats.fault("video camera was lost");
    EXPECT_EQ(stats.count().faults, 2U);
}

}  // namespace
}  // namespace mfar
