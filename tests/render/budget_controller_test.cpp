#include "pipeline/slices/budget_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace mfar {
namespace {

constexpr double kBudget = 4;  // [ms] of processor time per frame

using CostTrace = std::function<double(int frame)>;

/// Simulates a tracer that always has work. Each grant is used for at most `tile` samples, which
/// take cost(frame) [ms] each. Returns the time used in each frame [ms].
std::vector<double> usedIn(BudgetController& budget, int frames, int tile, const CostTrace& cost) {
    std::vector<double> used;
    for (int frame = 0; frame < frames; ++frame) {
        budget.beginFrame(frame > 0);
        for (BudgetGrant grant = budget.grant(); grant.samples > 0; grant = budget.grant()) {
            const std::int64_t samples = std::min<std::int64_t>(grant.samples, tile);
            budget.spent(grant, samples, static_cast<double>(samples) * cost(frame));
        }
        used.push_back(budget.used());
    }
    return used;
}

double meanShare(const std::vector<double>& used) {
    double sum = 0;
    for (const double ms : used)
        sum += ms;
    return sum / (kBudget * static_cast<double>(used.size()));
}

/// Returns the number of frames whose used time differs from the budget by more than `share` of the
/// budget.
int framesOff(const std::vector<double>& used, double share) {
    return static_cast<int>(std::ranges::count_if(
        used, [&](double ms) { return !(std::abs(ms / kBudget - 1) <= share); }));
}

TEST(BudgetController, EveryFrameUsesItsBudgetIfTheCostIsConstant) {
    BudgetController budget(kBudget);
    const std::vector<double> used = usedIn(budget, 300, 1000, [](int) { return 0.003; });
    EXPECT_NEAR(meanShare(used), 1, 0.001);
    EXPECT_EQ(framesOff(used, 0.02), 0);
}

TEST(BudgetController, FramesWithExtraTimeUseItAndCountAsKeepingTheBudget) {
    BudgetController budget(kBudget);
    const auto usedUp = [&] {
        for (BudgetGrant grant = budget.grant(); grant.samples > 0; grant = budget.grant())
            budget.spent(grant, grant.samples, static_cast<double>(grant.samples) * 0.001);
        return budget.used();
    };
    for (int frame = 0; frame < 40; ++frame) {
        const bool more = frame < 20;
        budget.beginFrame(frame > 0, more ? kBudget : 0);
        EXPECT_NEAR(usedUp() / kBudget, more ? 2 : 1, 0.1) << frame;
    }
    budget.beginFrame(true, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(budget.kept().frames, 40);
    EXPECT_LE(budget.kept().deviation, 0.1);
    EXPECT_NEAR(usedUp() / kBudget, 1, 0.1);
}

TEST(BudgetController, FramesKeepTheBudgetWithinTenPercentIfTheCostVaries) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        std::mt19937 random(seed);
        std::lognormal_distribution<double> noise(0, 0.4);
        const auto cost = [&](int frame) {
            const double level = frame < 100 ? 0.002 : frame < 200 ? 0.016 : 0.001;
            return level * noise(random);
        };
        BudgetController budget(kBudget);
        const std::vector<double> used = usedIn(budget, 300, 128, cost);
        EXPECT_NEAR(meanShare(used), 1, 0.01);
        EXPECT_LE(framesOff(used, 0.1), 15)
            << "in 95 of 100 frames, the used time must be within 10 % of the budget";
        budget.beginFrame(true);
        EXPECT_EQ(budget.kept().frames, BudgetController::kFrames);
        EXPECT_NEAR(budget.kept().mean, 1, 0.02);
        EXPECT_LE(budget.kept().deviation, 0.1);
    }
}

TEST(BudgetController, OutliersChangeNeitherTheEstimatedCostNorTheMeanTime) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    BudgetController budget(kBudget);
    double least = 1, most = 0;
    const std::vector<double> used = usedIn(budget, 300, 128, [&](int frame) {
        if (frame > 0) {
            least = std::min(least, budget.msPerSample());
            most = std::max(most, budget.msPerSample());
        }
        return uniform(random) < 0.02 ? 0.1 : 0.002;
    });
    EXPECT_DOUBLE_EQ(least, 0.002);
    EXPECT_DOUBLE_EQ(most, 0.002);
    EXPECT_NEAR(meanShare(used), 1, 0.02) << "frames after an outlier must save its excess time";
}

TEST(BudgetController, AdaptsToAJumpOfTheCostInThreeFrames) {
    BudgetController budget(kBudget);
    const std::vector<double> used =
        usedIn(budget, 60, 1000, [](int frame) { return frame < 30 ? 0.001 : 0.008; });
    for (std::size_t frame = 0; frame < used.size(); ++frame)
        if (frame < 30 || frame > 32) {
            EXPECT_NEAR(used[frame], kBudget, 0.1 * kBudget) << frame;
        }
    EXPECT_LT(used[30] + used[31] + used[32], 3.2 * kBudget);
}

TEST(BudgetController, GrantIsASmallPartOfTheFramesBudget) {
    BudgetController budget(kBudget);
    (void)usedIn(budget, 2, 1000, [](int) { return 0.001; });
    budget.beginFrame(true);
    const BudgetGrant grant = budget.grant();
    EXPECT_LE(grant.reservedMs, kBudget / 16 + 1e-9);
    EXPECT_GT(grant.samples, 200);
}

TEST(BudgetController, TimeOfAGrantIsNotGrantedAgainBeforeItIsReturned) {
    BudgetController budget(kBudget);
    (void)usedIn(budget, 2, 1000, [](int) { return 0.001; });
    budget.beginFrame(true);
    std::vector<BudgetGrant> out;
    double reserved = 0;
    for (BudgetGrant grant = budget.grant(); grant.samples > 0; grant = budget.grant()) {
        out.push_back(grant);
        reserved += grant.reservedMs;
    }
    EXPECT_NEAR(reserved, kBudget, 0.02 * kBudget);
    for (const BudgetGrant& grant : out)
        budget.spent(grant, 0, 0);
    EXPECT_GT(budget.grant().samples, 0);
    EXPECT_EQ(budget.used(), 0);
}

TEST(BudgetController, UnusedTimeOfIdleFramesIsNotCarriedOver) {
    BudgetController budget(kBudget);
    (void)usedIn(budget, 10, 1000, [](int) { return 0.001; });
    for (int i = 0; i < 100; ++i)
        budget.beginFrame(false);
    const std::vector<double> used = usedIn(budget, 1, 1000, [](int) { return 0.001; });
    EXPECT_NEAR(used[0], kBudget, 0.05 * kBudget);
    EXPECT_EQ(budget.kept().frames, 9) << "idle frames do not count";
}

TEST(BudgetController, ManyFramesTogetherSaveTheTimeForConvertingAPicture) {
    BudgetController budget(kBudget);
    const auto cheap = [](int) { return 0.001; };
    (void)usedIn(budget, 2, 1000, cheap);
    std::vector<double> used;
    for (int picture = 0; picture < 10; ++picture) {
        budget.beginFrame(true);
        budget.spentElsewhere(2 * kBudget);
        EXPECT_EQ(budget.grant().samples, 0) << "the frame's own budget is used up";
        used.push_back(budget.used());
        for (int i = 0; i < 29; ++i) {
            budget.beginFrame(true);
            for (BudgetGrant g = budget.grant(); g.samples > 0; g = budget.grant())
                budget.spent(g, g.samples, 0.001 * static_cast<double>(g.samples));
            used.push_back(budget.used());
        }
    }
    EXPECT_EQ(framesOff(used, 0.1), 10) << "only frames with a conversion may miss their budget";
    EXPECT_NEAR(meanShare(used), 1, 0.01);
    budget.beginFrame(true);
    EXPECT_LE(budget.kept().deviation, 0.1);
}

TEST(BudgetController, IdleFramesMakeUpForTimeUsedBeyondTheBudget) {
    BudgetController budget(kBudget);
    (void)usedIn(budget, 2, 1000, [](int) { return 0.001; });
    budget.beginFrame(true);
    budget.spentElsewhere(4 * kBudget);
    for (int i = 0; i < 4; ++i)
        budget.beginFrame(false);
    EXPECT_NEAR(usedIn(budget, 1, 1000, [](int) { return 0.001; })[0], kBudget, 0.05 * kBudget);
}

TEST(BudgetController, FramesThatDoNotUseUpTheirBudgetAreNotCounted) {
    BudgetController budget(kBudget);
    (void)usedIn(budget, 10, 1000, [](int) { return 0.001; });
    for (int i = 0; i < 50; ++i) {
        budget.beginFrame(true);
        const BudgetGrant grant = budget.grant();
        budget.spent(grant, grant.samples, grant.reservedMs);
    }
    budget.beginFrame(true);
    EXPECT_EQ(budget.kept().frames, 10);
    EXPECT_LE(budget.kept().deviation, 0.02);
}

TEST(BudgetController, MeanUsedTimeCountsAllFramesWithWaitingWork) {
    BudgetController budget(kBudget);
    EXPECT_EQ(budget.kept().mean, 0);
    budget.beginFrame(true);
    for (int i = 0; i < 20; ++i) {
        budget.spent(budget.grant(), 1000, 0.25 * kBudget);
        budget.beginFrame(true);
    }
    EXPECT_EQ(budget.kept().frames, 0) << "no frame used up its budget";
    EXPECT_NEAR(budget.kept().mean, 0.25 * 20 / 21, 1e-6);
}

TEST(BudgetController, InvalidTimesAreIgnored) {
    BudgetController budget(kBudget);
    (void)usedIn(budget, 2, 1000, [](int) { return 0.001; });
    budget.beginFrame(true);
    for (const double odd : {std::nan(""), std::numeric_limits<double>::infinity(), -1.0})
        for (int i = 0; i < 20; ++i)
            budget.spent({}, 10, odd);
    EXPECT_DOUBLE_EQ(budget.msPerSample(), 0.001);
    EXPECT_EQ(budget.used(), 0);
    for (const double odd : {std::nan(""), std::numeric_limits<double>::infinity(), 0.0, -1.0})
        EXPECT_THROW(BudgetController{odd}, std::invalid_argument);
}

}  // namespace
}  // namespace mfar
