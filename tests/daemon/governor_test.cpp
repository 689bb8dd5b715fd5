#include "daemon/governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace mfar {
namespace {

std::vector<QualityLevel> fourLevels() {
    std::vector<QualityLevel> out{{"off", 25, 24, {.mode = SuperResMode::Off}},
                                  {"a", 55, 27, {}},
                                  {"b", 80, 28, {}},
                                  {"c", 120, 29, {}}};
    return out;
}

/// A simulated machine on which a frame at each quality level takes a given time.
class Machine {
public:
    using Cost = std::function<double(std::size_t level)>;

    Machine(double deadlineMs, Cost cost)
        : governor_(fourLevels(), deadlineMs), cost_(std::move(cost)) {}

    void setCost(Cost cost) { cost_ = std::move(cost); }
    /// Runs frames whose times vary by 4 % (standard deviation). `changed`: share of the picture
    /// that changes in each frame. Returns the share of late frames.
    double run(int frames, double changed = 1) {
        int late = 0;
        for (int i = 0; i < frames; ++i) {
            double ms = 1.5;
            if (changed > 0 || governor_.next().redraw)
                ms = cost_(governor_.next().level) * (1 + 0.04 * noise_(random_));
            if (ms > governor_.deadlineMs()) ++late;
            governor_.add({.ms = ms, .redrawn = governor_.next().redraw ? 1 : changed});
        }
        return static_cast<double>(late) / frames;
    }
    [[nodiscard]] Governor& governor() { return governor_; }
    [[nodiscard]] std::string level() const { return governor_.level().name; }

private:
    Governor governor_;
    Cost cost_;
    std::mt19937 random_{1};
    std::normal_distribution<double> noise_;
};

Machine::Cost scaled(double factor) {
    return [factor](std::size_t level) { return factor * fourLevels()[level].ms; };
}

TEST(Governor, StartsWithTheBestLevelWhoseTimeInTheTableMeetsTheDeadline) {
    for (const auto& [deadline, level] :
         {std::pair{10., "off"}, {33., "off"}, {66., "a"}, {100., "b"}, {133., "b"}, {150., "c"}})
        EXPECT_EQ(Governor(fourLevels(), deadline).level().name, level) << deadline;
}

TEST(Governor, MeetsEveryDeadlineThatAnyLevelCanMeet) {
    for (const double deadline : {33.0, 66.0, 133.0}) {
        for (const double factor : {0.2, 0.5, 1.0, 1.2, 1.9}) {
            if (factor * fourLevels()[0].ms > 0.85 * deadline) continue;
            Machine machine(deadline, scaled(factor));
            machine.run(30);
            EXPECT_LE(machine.run(600), 0.05) << deadline << " ms, machine " << factor;
            const std::size_t level = machine.governor().next().level;
            if (level + 1 < fourLevels().size()) {
                EXPECT_GT(factor * fourLevels()[level + 1].ms, 0.75 * deadline)
                    << deadline << " ms, machine " << factor << ", " << machine.level();
            }
        }
    }
}

TEST(Governor, FindsTheLevelWithin30FramesAfterAChangeOfScene) {
    Machine machine(100, scaled(0.6));
    machine.run(60);
    EXPECT_EQ(machine.level(), "c");
    machine.setCost(scaled(1.4));
    machine.run(30);
    EXPECT_EQ(machine.level(), "a");
    EXPECT_LE(machine.run(300), 0.05);
    machine.setCost(scaled(0.6));
    machine.run(30);
    EXPECT_EQ(machine.level(), "c");
    EXPECT_EQ(machine.run(300), 0);
}

TEST(Governor, FindsTheLevelFastAlsoAfterManyChangesOfScene) {
    Machine machine(100, scaled(0.6));
    for (int i = 0; i < 10; ++i) {
        machine.setCost(scaled(1.4));
        machine.run(150);
        machine.setCost(scaled(0.6));
        machine.run(30);
        EXPECT_EQ(machine.level(), "c") << i;
        machine.run(120);
    }
}

TEST(Governor, AtMostFourFramesAreLateWhenEverythingBecomesSlower) {
    Machine machine(100, scaled(0.6));
    machine.run(60);
    machine.setCost(scaled(3));
    EXPECT_LE(machine.run(30) * 30, 4);
}

TEST(Governor, MeetsTheDeadlineAlthoughTheTableIsWrong) {
    Machine machine(100, [](std::size_t level) { return level == 2 ? 110.0 : 20.0 + 25 * level; });
    machine.run(60);
    EXPECT_LE(machine.run(2000), 0.05) << "level b takes longer than c, contrary to the table";
    EXPECT_LE(machine.governor().changes(), 60U);
}

TEST(Governor, DoesNotAlternateBetweenTwoLevels) {
    for (double factor = 0.6; factor < 1.2; factor += 0.05) {
        Machine machine(100, scaled(factor));
        machine.run(1000);
        EXPECT_LE(machine.governor().changes(), 8U) << factor;
    }
}

TEST(Governor, ReturnsToItsLevelAfterAStallIfPartOfTheTimeIsTheSameAtAllLevels) {
    for (const double constant : {30.0, 35.0}) {
        const auto cost = [&](std::size_t level) { return fourLevels()[level].ms + constant; };
        Machine machine(150, cost);
        machine.run(300);
        EXPECT_EQ(machine.level(), "b") << constant;
        machine.setCost([&](std::size_t level) { return 6 * cost(level); });
        machine.run(20);
        EXPECT_EQ(machine.level(), "off") << constant;
        EXPECT_FALSE(machine.governor().mayTakeStill());
        machine.setCost(cost);
        machine.run(300);
        EXPECT_EQ(machine.level(), "b") << constant;
        EXPECT_TRUE(machine.governor().mayTakeStill());
        EXPECT_LE(machine.run(2000), 0.01) << constant;
    }
}

TEST(Governor, TrialsOfALevelThatIsTooSlowMakeFewFramesLate) {
    Machine machine(133, scaled(3));
    EXPECT_LE(machine.run(5000), 0.01);
    EXPECT_EQ(machine.level(), "off");
    const std::uint64_t before = machine.governor().changes();
    machine.run(5000);
    EXPECT_GT(machine.governor().changes(), before);
    EXPECT_LE(machine.governor().changes(), before + 12) << "at most one trial in 960 frames";
}

TEST(Governor, OneLateFrameInFiftyDoesNotChangeTheLevel) {
    Governor governor(fourLevels(), 100);
    for (int i = 0; i < 400; ++i)
        governor.add({i % 50 == 49 ? 300.0 : 80.0});
    EXPECT_EQ(governor.level().name, "b");
    EXPECT_EQ(governor.changes(), 0U);
}

TEST(Governor, AStaticPictureIsDrawnOnceMoreAtTheBestLevel) {
    Machine machine(66, scaled(1));
    machine.run(40);
    ASSERT_EQ(machine.level(), "a");
    int redrawn = 0;
    for (int i = 0; i < 100; ++i) {
        machine.run(1, 0);
        if (machine.governor().next().redraw) {
            ++redrawn;
            EXPECT_EQ(machine.level(), "c");
        }
    }
    EXPECT_EQ(redrawn, 1);
    EXPECT_EQ(machine.level(), "a") << "frames at rest must not change the level";
    machine.run(10);
    EXPECT_EQ(machine.level(), "a");
    EXPECT_EQ(machine.governor().changes(), 0U);
    machine.run(10, 0);
    machine.run(1);
    EXPECT_LE(machine.run(100), 0.05);
}

TEST(Governor, StillsThatMakeFramesLateAreAllowedOnceInFortyFrames) {
    Governor governor(fourLevels(), 100);
    EXPECT_TRUE(governor.mayTakeStill());
    governor.add({.ms = 300, .newStill = true});
    for (int i = 0; i < 39; ++i) {
        EXPECT_FALSE(governor.mayTakeStill()) << i;
        governor.add({80});
    }
    governor.add({80});
    EXPECT_TRUE(governor.mayTakeStill());
    EXPECT_EQ(governor.level().name, "b") << "frames with a new still must not change the level";
    governor.add({.ms = 90, .newStill = true});
    governor.add({80});
    EXPECT_TRUE(governor.mayTakeStill())
        << "after a still whose frame was in time, the next still is allowed";
}

TEST(Governor, TheTimeForAStillDoesNotCountAsTimeOfTheLevel) {
    Governor governor(fourLevels(), 100);
    for (int i = 0; i < 10; ++i) {
        governor.add({.ms = 300, .newStill = true});
        governor.add({.ms = 80});
    }
    EXPECT_EQ(governor.level().name, "b");
}

TEST(Governor, IfEachFrameHasANewStillTheseFramesCount) {
    Governor governor(fourLevels(), 100);
    for (int i = 0; i < 100; ++i)
        governor.add({.ms = 4 * fourLevels()[0].ms, .newStill = true});
    EXPECT_EQ(governor.level().name, "b") << "100 ms are in time";
    for (int i = 0; i < 20; ++i)
        governor.add({.ms = 150, .newStill = true});
    EXPECT_NE(governor.level().name, "b");
}

TEST(Governor, RequestsNoStillForALevelWithoutStills) {
    Governor governor(fourLevels(), 30);
    EXPECT_EQ(governor.level().name, "off");
    EXPECT_FALSE(governor.mayTakeStill());
}

TEST(Governor, FramesWithoutAStillDoNotCountForLevelsThatUseStills) {
    Governor governor(fourLevels(), 100);
    for (int i = 0; i < 100; ++i)
        governor.add({.ms = 20, .usedStill = false});
    EXPECT_EQ(governor.level().name, "b");
    Governor fast(fourLevels(), 30);
    for (int i = 0; i < 100; ++i)
        fast.add({.ms = 2, .usedStill = false});
    EXPECT_EQ(fast.level().name, "c") << "frames without a still must count for level \"off\"";
}

TEST(Governor, IgnoresInvalidTimes) {
    Governor governor(fourLevels(), 100);
    for (int i = 0; i < 100; ++i)
        for (const double ms : {std::numeric_limits<double>::quiet_NaN(), -1.0,
                                std::numeric_limits<double>::infinity()})
            governor.add({ms});
    EXPECT_EQ(governor.level().name, "b");
    EXPECT_EQ(governor.changes(), 0U);
}

TEST(Governor, TheOnlyLevelIsKept) {
    Governor governor({{"only", 100, 20, {}}}, 10);
    for (int i = 0; i < 100; ++i) {
        governor.add({200});
        EXPECT_EQ(governor.next(), (Governor::Choice{0, false}));
    }
}

}  // namespace
}  // namespace mfar
