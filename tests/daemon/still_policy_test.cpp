#include "daemon/still_policy.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

constexpr double kFrame = 1.0 / 30;

TEST(StillPolicy, ABusyTriggerIsRetriedAtOnce) {
    StillPolicy policy({.mode = TriggerMode::Rate, .rateHz = 0.5});
    const auto at = [](double s) { return Timestamp::fromSeconds(s); };
    ASSERT_TRUE(policy.decide(at(100), at(100), {}));
    policy.busy();
    EXPECT_EQ(policy.fired(), 0);
    EXPECT_FALSE(policy.pending());
    EXPECT_TRUE(policy.decide(at(100.03), at(100), {}));
    EXPECT_EQ(policy.fired(), 1);
    EXPECT_FALSE(policy.decide(at(100.07), at(100.03), {}));
    EXPECT_EQ(policy.timedOut(), 0);
}

TEST(StillPolicy, ATriggerThatCannotFireIsNotCountedAndIsRetriedAfterASecond) {
    StillPolicy policy({});
    const auto at = [](double s) { return Timestamp::fromSeconds(s); };
    for (int i = 0; i < 5; ++i) {
        ASSERT_TRUE(policy.decide(at(100 + i), at(100 + i), {})) << i;
        policy.failed();
        EXPECT_FALSE(policy.decide(at(100.9 + i), at(100.8 + i), {})) << i;
    }
    EXPECT_EQ(policy.fired(), 0);
    EXPECT_EQ(policy.timedOut(), 0);
    EXPECT_TRUE(policy.decide(at(105), at(104.9), {}));
    EXPECT_EQ(policy.fired(), 1);
    EXPECT_TRUE(policy.pending());
}

TEST(StillPolicy, ANewRateDoesNotWaitForTheEndOfTheOldPeriod) {
    StillPolicy policy({.mode = TriggerMode::Rate, .rateHz = 0.01});
    const auto at = [](double s) { return Timestamp::fromSeconds(s); };
    ASSERT_TRUE(policy.decide(at(100), at(100), {}));
    policy.stillArrived(at(100.1));
    EXPECT_FALSE(policy.decide(at(101), at(100.9), {}));
    policy.configure({.mode = TriggerMode::Rate, .rateHz = 10});
    EXPECT_TRUE(policy.decide(at(101.1), at(101), {}));
}

/// A still sensor that answers a trigger after a fixed time, or never.
class Simulation {
public:
    explicit Simulation(const TriggerConfig& config) : policy(config) {}

    /// Runs frames for `seconds`. Returns the number of times that the policy fired the trigger.
    int run(double seconds, FrameStats stats) {
        int fired = 0;
        for (const double end = now + seconds; now < end; now += kFrame) {
            if (answerAt && now >= *answerAt) {
                policy.stillArrived(Timestamp::fromSeconds(*answerAt - latency / 2));
                answerAt.reset();
            }
            if (!policy.decide(Timestamp::fromSeconds(now), Timestamp::fromSeconds(now - kFrame),
                               stats, mayDemand))
                continue;
            ++fired;
            firedAt.push_back(now);
            if (answers) answerAt = now + latency;
        }
        return fired;
    }

    StillPolicy policy;
    double now = 100;
    bool mayDemand = true;
    double latency = 0.2;
    bool answers = true;
    std::optional<double> answerAt;
    std::vector<double> firedAt;
};

FrameStats frame(double explained, double changed) {
    FrameStats stats;
    stats.explained = explained;
    stats.changed = changed;
    return stats;
}

const FrameStats kRest = frame(0.95, 0);
const FrameStats kMovingExplained = frame(0.9, 0.8);
const FrameStats kMovingUnexplained = frame(0.2, 0.8);

TEST(StillPolicy, WithoutAStillTheFirstFrameFiresTheTrigger) {
    Simulation board({});
    EXPECT_EQ(board.run(kFrame / 2, frame(0, 1)), 1);
}

TEST(StillPolicy, WithACameraAtRestTheTriggerFiresOnce) {
    Simulation board({});
    EXPECT_EQ(board.run(3600, kRest), 1);
}

TEST(StillPolicy, WithACameraAtRestTheTriggerFiresOnceEvenIfNoPixelMatchesTheStill) {
    Simulation board({});
    EXPECT_EQ(board.run(600, frame(0, 0.01)), 1);
}

// In the first frame, every tile has changed. That frame fires the trigger.
TEST(StillPolicy, TheFirstFrameDoesNotCountAsMotion) {
    Simulation board({});
    EXPECT_EQ(board.run(kFrame / 2, frame(0, 1)), 1);
    EXPECT_EQ(board.run(60, frame(0.1, 0)), 0);
}

TEST(StillPolicy, TheExplainedShareFromBeforeTheMotionIsIgnored) {
    Simulation board({});
    board.run(2, kRest);
    EXPECT_EQ(board.run(kFrame / 2, frame(0.2, 0.8)), 0)
        << "the explained share 0.2 belongs to the frame before";
    EXPECT_EQ(board.run(5, frame(0.9, 0)), 0);
}

TEST(StillPolicy, StatsOlderThanTheStillAreIgnored) {
    TriggerConfig config;
    config.minIntervalS = 0;
    Simulation board(config);
    board.run(1, kRest);
    board.latency = 6.5 * kFrame;
    EXPECT_EQ(board.run(6.5 * kFrame, kMovingUnexplained), 1);
    EXPECT_EQ(board.run(0.5 * kFrame, kMovingUnexplained), 0)
        << "statistics from before the still must be ignored";
    EXPECT_EQ(board.run(2, kMovingExplained), 0);
}

TEST(StillPolicy, AViewThatTheStillDoesNotShowFiresTheTrigger) {
    Simulation board({});
    board.run(2, kRest);
    EXPECT_EQ(board.run(kFrame * 1.5, kMovingUnexplained), 1);
}

TEST(StillPolicy, MotionWhileNoStillMayBeDemandedIsRemembered) {
    Simulation board({});
    board.run(2, kRest);
    board.mayDemand = false;
    EXPECT_EQ(board.run(1, kMovingUnexplained), 0);
    board.mayDemand = true;
    EXPECT_EQ(board.run(30, frame(0.2, 0)), 1);
}

TEST(StillPolicy, CommandsAndModeRateFireTheTriggerEvenIfDemandIsForbidden) {
    for (const TriggerMode mode : {TriggerMode::Demand, TriggerMode::Off}) {
        Simulation board({.mode = mode});
        board.mayDemand = false;
        EXPECT_EQ(board.run(3, kMovingUnexplained), 0);
        board.policy.ask();
        EXPECT_EQ(board.run(3, kMovingUnexplained), 1);
    }
    Simulation rate({.mode = TriggerMode::Rate, .rateHz = 2});
    rate.mayDemand = false;
    EXPECT_EQ(rate.run(2.9, kRest), 6);
}

TEST(StillPolicy, AfterMotionWithinTheViewOfTheStillTheTriggerFiresOnlyAtTheAgeLimit) {
    TriggerConfig config;
    config.maxAgeS = 5;
    Simulation board(config);
    board.run(1, kRest);
    EXPECT_EQ(board.run(3.9, kMovingExplained), 0);
    EXPECT_EQ(board.run(0.5, kMovingExplained), 1);
}

// The first frames appear to change, because the sensor's noise is not yet known.
TEST(StillPolicy, ChangesBeforeTheFirstUseOfAStillDoNotMakeTheStillTooOld) {
    TriggerConfig config;
    config.maxAgeS = 5;
    Simulation board(config);
    board.run(0.1, frame(0, 1));
    EXPECT_EQ(board.run(60, kRest), 0);
}

// The camera turns and stops while the still is pending. So the still shows the wrong view.
TEST(StillPolicy, AStillExposedDuringMotionIsReplaced) {
    Simulation board({});
    board.latency = 0.4;
    board.run(0.3, kMovingUnexplained);
    EXPECT_EQ(board.run(30, frame(0.2, 0)), 1);
}

TEST(StillPolicy, MotionBeforeTheAgeLimitCausesANewStillAtTheAgeLimit) {
    TriggerConfig config;
    config.maxAgeS = 5;
    Simulation board(config);
    board.run(1, kRest);
    board.run(0.2, kMovingExplained);
    EXPECT_EQ(board.run(10, kRest), 1);
}

TEST(StillPolicy, NeverFiresWhileAStillIsPending) {
    TriggerConfig config;
    config.minIntervalS = 0;
    Simulation board(config);
    board.latency = 1;
    board.run(10, kMovingUnexplained);
    for (std::size_t i = 1; i < board.firedAt.size(); ++i)
        EXPECT_GE(board.firedAt[i] - board.firedAt[i - 1], board.latency);
    EXPECT_GE(board.firedAt.size(), 9U);
}

TEST(StillPolicy, KeepsTheMinimumIntervalBetweenStills) {
    TriggerConfig config;
    config.minIntervalS = 0.5;
    Simulation board(config);
    board.latency = 0.05;
    board.run(10, kMovingUnexplained);
    for (std::size_t i = 1; i < board.firedAt.size(); ++i)
        EXPECT_GE(board.firedAt[i] - board.firedAt[i - 1], 0.5 - 1e-6);
    EXPECT_GE(board.firedAt.size(), 18U);
}

TEST(StillPolicy, ALostStillIsCountedAndRequestedAgain) {
    TriggerConfig config;
    config.timeoutS = 1;
    config.maxAgeS = 30;
    Simulation board(config);
    board.answers = false;
    EXPECT_EQ(board.run(11, kRest), 2);
    EXPECT_EQ(board.policy.timedOut(), 2);
    EXPECT_EQ(board.policy.repetitions(), 1);
    EXPECT_NEAR(board.firedAt[1] - board.firedAt[0], 1, 2 * kFrame);
}

TEST(StillPolicy, AStillThatIsComingIsNotLostUntilItsTimeoutAfterTheLastNews) {
    StillPolicy policy({.mode = TriggerMode::Rate, .rateHz = 0.01, .timeoutS = 3});
    const auto at = [](double s) { return Timestamp::fromSeconds(s); };
    ASSERT_TRUE(policy.decide(at(100), at(100), {}));
    policy.stillIsComing(at(110));
    EXPECT_FALSE(policy.decide(at(110), at(110), {}));
    EXPECT_FALSE(policy.decide(at(112.9), at(110), {}));
    EXPECT_EQ(policy.timedOut(), 0);
    EXPECT_TRUE(policy.decide(at(113.1), at(112.9), {}));
    EXPECT_EQ(policy.timedOut(), 1);
}

/// Returns a board that has run for `seconds` and has requested two stills. Both were lost.
Simulation withTwoLostStills(TriggerConfig config, double seconds) {
    config.timeoutS = 1;
    Simulation board(config);
    board.answers = false;
    board.run(seconds, kRest);
    EXPECT_EQ(board.firedAt.size(), 2U);
    return board;
}

TEST(StillPolicy, AfterTwoLostStillsTheNextIsRequestedAtTheAgeLimit) {
    TriggerConfig config;
    config.maxAgeS = 3;
    Simulation board = withTwoLostStills(config, 4.5);
    board.answers = true;
    EXPECT_EQ(board.run(60, kRest), 1);
    EXPECT_EQ(board.policy.timedOut(), 2);
}

TEST(StillPolicy, AfterTwoLostStillsTheNextIsRequestedWithinTenSeconds) {
    TriggerConfig config;
    config.maxAgeS = 3600;
    Simulation board = withTwoLostStills(config, 2.5);
    EXPECT_EQ(board.run(10, kRest), 1);
}

TEST(StillPolicy, AReloadEndsThePauseAfterTwoLostStills) {
    Simulation board = withTwoLostStills({}, 2.5);
    board.policy.configure({});
    EXPECT_EQ(board.run(0.5, kRest), 1);
}

TEST(StillPolicy, ALateStillIsNotMistakenForTheStillRequestedAgain) {
    TriggerConfig config;
    config.timeoutS = 1;
    Simulation board(config);
    board.answers = false;
    board.run(1.2, kRest);
    ASSERT_EQ(board.firedAt.size(), 2U);
    board.policy.stillArrived(Timestamp::fromSeconds(board.firedAt[0] + 0.1));
    EXPECT_TRUE(board.policy.pending());
    board.policy.stillArrived(Timestamp::fromSeconds(board.firedAt[1] + 0.1));
    EXPECT_FALSE(board.policy.pending());
}

TEST(StillPolicy, InModeRateTheTriggerFiresAtTheConfiguredRate) {
    TriggerConfig config;
    config.mode = TriggerMode::Rate;
    config.rateHz = 4;
    Simulation board(config);
    const int fired = board.run(30, kRest);
    EXPECT_NEAR(fired, 120, 1);
}

TEST(StillPolicy, InModeOffThePolicyFiresNoTriggerByItself) {
    TriggerConfig config;
    config.mode = TriggerMode::Off;
    Simulation board(config);
    EXPECT_EQ(board.run(30, kMovingUnexplained), 0);
}

TEST(StillPolicy, InModeOffALostStillThatACommandRequestedIsRequestedOnceMore) {
    TriggerConfig config;
    config.mode = TriggerMode::Off;
    Simulation board(config);
    board.answers = false;
    board.policy.ask();
    EXPECT_EQ(board.run(30, kRest), 2);
    EXPECT_EQ(board.policy.timedOut(), 2);
    board.answers = true;
    board.policy.ask();
    EXPECT_EQ(board.run(30, kRest), 1);
    EXPECT_EQ(board.policy.timedOut(), 2);
}

TEST(StillPolicy, AReloadToModeOffCancelsAPendingStill) {
    Simulation board({});
    board.answers = false;
    board.run(0.1, kRest);
    ASSERT_TRUE(board.policy.pending());
    TriggerConfig config;
    config.mode = TriggerMode::Off;
    board.policy.configure(config);
    EXPECT_EQ(board.run(30, kRest), 0);
    EXPECT_EQ(board.policy.timedOut(), 0);
}

TEST(StillPolicy, AReloadFromModeOffToDemandFiresTheTrigger) {
    TriggerConfig config;
    config.mode = TriggerMode::Off;
    Simulation board(config);
    board.run(1, kRest);
    board.policy.configure({});
    EXPECT_EQ(board.run(5, kRest), 1);
}

}  // namespace
}  // namespace mfar
