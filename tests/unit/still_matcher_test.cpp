#include "hal/still_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

namespace mfar {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;
using Pulse = StillMatcher::Pulse;

constexpr Timestamp kStart{5'000'000'000'000};

StillMatcherOptions fast() {
    StillMatcherOptions options;
    options.learnFrom = 1;
    options.wideWindow = 1ms;
    return options;
}

TEST(StillMatcher, StillOfAPulseIsMatchedAndGetsItsTimeFromThePulse) {
    StillMatcher matcher(fast());
    matcher.pulseFired(kStart);
    const auto match = matcher.stillArrived(kStart + 400us);
    ASSERT_TRUE(match);
    EXPECT_EQ(match->pulse, kStart);
    EXPECT_EQ(match->exposed, kStart + 400us);
    EXPECT_FALSE(match->late);
    EXPECT_TRUE(matcher.learned());
    matcher.pulseFired(kStart + 1s);
    EXPECT_EQ(matcher.stillArrived(kStart + 1s + 900us)->exposed, kStart + 1s + 400us)
        << "the jitter of the still's own time is removed";
}

TEST(StillMatcher, StillWithoutAPulseIsNeverUsed) {
    StillMatcher matcher(fast());
    EXPECT_FALSE(matcher.stillArrived(kStart));
    matcher.pulseFired(kStart);
    EXPECT_FALSE(matcher.stillArrived(kStart + 1001us));
    EXPECT_FALSE(matcher.stillArrived(kStart - 1001us));
    EXPECT_TRUE(matcher.stillArrived(kStart + 1000us));
    EXPECT_FALSE(matcher.stillArrived(kStart + 1000us)) << "the pulse already has a still";
    EXPECT_EQ(matcher.counters().unmatched, 4U);
    EXPECT_EQ(matcher.counters().matched, 1U);
}

TEST(StillMatcher, TheLearnedLatencyIsTheMedianOfTheFirstTwentyStills) {
    StillMatcherOptions options;
    options.guess = 20ms;
    StillMatcher matcher(options);
    EXPECT_EQ(matcher.constant(), nanoseconds(20ms));
    // The latencies are 30.00 to 30.19 ms in mixed order, but pulse 4 has 90 ms instead of 30.08
    // ms.
    for (int i = 0; i < 20; ++i) {
        EXPECT_FALSE(matcher.learned()) << i;
        const Timestamp pulse = kStart + i * 1s;
        matcher.pulseFired(pulse);
        const nanoseconds off = i == 4 ? nanoseconds(90ms) : 30ms + microseconds(i * 7 % 20 * 10);
        EXPECT_TRUE(matcher.stillArrived(pulse + off)) << i;
    }
    EXPECT_TRUE(matcher.learned());
    // Without 30.08 ms, the two middle values of the 20 latencies are 30.10 and 30.11 ms.
    EXPECT_EQ(matcher.constant(), nanoseconds(30ms + 105us));
    matcher.pulseFired(kStart + 100s);
    EXPECT_FALSE(matcher.stillArrived(kStart + 100s + 31106us))
        << "the window is 1 ms once the latency is known";
    EXPECT_TRUE(matcher.stillArrived(kStart + 100s + 31105us));
}

TEST(StillMatcher, MatchingWindowIsAtMostHalfATriggerPeriod) {
    StillMatcherOptions options;
    options.window = 50ms;
    options.wideWindow = 50ms;
    StillMatcher matcher(options);
    matcher.pulseFired(kStart);
    matcher.pulseFired(kStart + 20ms);
    EXPECT_FALSE(matcher.stillArrived(kStart + 31ms))
        << "after the last pulse, the window is half of the period before it";
    EXPECT_FALSE(matcher.stillArrived(kStart - 11ms));
    EXPECT_EQ(matcher.stillArrived(kStart + 10001us)->pulse, kStart + 20ms);
    EXPECT_EQ(matcher.stillArrived(kStart + 9999us)->pulse, kStart);
}

TEST(StillMatcher, StillsInSwappedOrderAreMatchedWithTheirPulses) {
    StillMatcher matcher(fast());
    for (int i = 0; i < 3; ++i)
        matcher.pulseFired(kStart + i * 100ms);
    for (const int i : {2, 0, 1}) {
        const auto match = matcher.stillArrived(kStart + i * 100ms + 200us);
        ASSERT_TRUE(match) << i;
        EXPECT_EQ(match->pulse, kStart + i * 100ms);
    }
}

TEST(StillMatcher, LostPulseIsReportedOnceAndRepeatedOnce) {
    StillMatcher matcher(fast());
    matcher.pulseFired(kStart);
    StillMatcher::Due due = matcher.poll(kStart + 500ms);
    EXPECT_EQ(due.lost, 0);
    EXPECT_FALSE(due.repeat);
    due = matcher.poll(kStart + 501ms);
    EXPECT_EQ(due.lost, 1);
    EXPECT_TRUE(due.repeat);
    due = matcher.poll(kStart + 502ms);
    EXPECT_EQ(due.lost, 0);
    EXPECT_TRUE(due.repeat) << "a repetition stays due until the trigger fires";
    matcher.pulseFired(kStart + 503ms, Pulse::Repetition);
    EXPECT_FALSE(matcher.poll(kStart + 504ms).repeat);
    due = matcher.poll(kStart + 2s);
    EXPECT_EQ(due.lost, 1) << "the repetition is lost as well";
    EXPECT_FALSE(due.repeat) << "a repetition is not repeated again";
    EXPECT_EQ(matcher.counters().fired, 2U);
    EXPECT_EQ(matcher.counters().lost, 2U);
    EXPECT_EQ(matcher.counters().repeated, 1U);
}

TEST(StillMatcher, EachOfSeveralLostPulsesIsRepeatedOnce) {
    StillMatcher matcher(fast());
    for (int i = 0; i < 3; ++i)
        matcher.pulseFired(kStart + i * 10ms);
    EXPECT_EQ(matcher.poll(kStart + 1s).lost, 3);
    int repeated = 0;
    while (matcher.poll(kStart + 1s).repeat) {
        matcher.pulseFired(kStart + 1s + repeated * 10ms, Pulse::Repetition);
        ++repeated;
        ASSERT_LE(repeated, 3);
    }
    EXPECT_EQ(repeated, 3);
}

TEST(StillMatcher, RepetitionOfLostPulsesCanBeSwitchedOff) {
    StillMatcherOptions options = fast();
    options.repeat = false;
    StillMatcher matcher(options);
    matcher.pulseFired(kStart);
    const StillMatcher::Due due = matcher.poll(kStart + 1s);
    EXPECT_EQ(due.lost, 1);
    EXPECT_FALSE(due.repeat);
}

TEST(StillMatcher, LateStillIsMatchedAndItsPulseIsNotRepeated) {
    StillMatcher matcher(fast());
    matcher.pulseFired(kStart);
    EXPECT_TRUE(matcher.poll(kStart + 1s).repeat);
    const auto match = matcher.stillArrived(kStart + 100us);
    ASSERT_TRUE(match);
    EXPECT_TRUE(match->late);
    EXPECT_FALSE(matcher.poll(kStart + 1s).repeat);
    EXPECT_EQ(matcher.counters().late, 1U);
    EXPECT_EQ(matcher.counters().lost, 1U);
}

TEST(StillMatcher, LatencyIsLearnedAgainAfterAClockStep) {
    for (const milliseconds step : {-450ms, -40ms, 7ms, 80ms, 101ms, 490ms}) {
        StillMatcher matcher({});
        Timestamp pulse = kStart;
        const auto shoot = [&](nanoseconds offset) {
            pulse = pulse + 1s;
            matcher.pulseFired(pulse);
            const bool matched = matcher.stillArrived(pulse + offset).has_value();
            (void)matcher.poll(pulse + 900ms);
            return matched;
        };
        for (int i = 0; i < 25; ++i)
            EXPECT_TRUE(shoot(2ms + microseconds(i)));
        for (int i = 0; i < 5; ++i)
            EXPECT_FALSE(shoot(2ms + step + microseconds(i)));
        for (int i = 0; i < 25; ++i)
            EXPECT_TRUE(shoot(2ms + step + microseconds(i)));
        EXPECT_EQ(matcher.counters().relearned, 1U);
        EXPECT_EQ(matcher.counters().lost, 5U);
        EXPECT_EQ(matcher.constant(), 2ms + step + 2us);
    }
}

TEST(StillMatcher, AFirstEstimateThatIsWrongByMoreThanTheWindowIsCorrected) {
    StillMatcher matcher({});
    for (int i = 0; i < 40; ++i) {
        const Timestamp pulse = kStart + i * 1s;
        matcher.pulseFired(pulse);
        EXPECT_EQ(matcher.stillArrived(pulse + 120ms + microseconds(i)).has_value(), i >= 5) << i;
        (void)matcher.poll(pulse + 900ms);
    }
    EXPECT_TRUE(matcher.learned());
    EXPECT_EQ(matcher.constant(), 120ms + 2us);
    EXPECT_EQ(matcher.counters().relearned, 0U) << "nothing was learned before";
}

TEST(StillMatcher, AFirstEstimateIsCorrectedEvenIfStillsArriveAfterTheTimeout) {
    StillMatcher matcher({});
    int matched = 0;
    for (int i = 0; i < 20; ++i) {
        const Timestamp pulse = kStart + i * 4s;
        matcher.pulseFired(pulse);
        (void)matcher.poll(pulse + 850ms);
        matched += matcher.stillArrived(pulse + 900ms).has_value();
    }
    EXPECT_EQ(matched, 15);
    EXPECT_EQ(matcher.constant(), 900ms);
}

TEST(StillMatcher, AStepOfSeveralTriggerPeriodsIsNotLearned) {
    StillMatcher matcher({});
    for (int i = 0; i < 60; ++i) {
        const Timestamp pulse = kStart + i * 1s;
        matcher.pulseFired(pulse);
        const nanoseconds step = i < 25 ? 0ms : -2700ms;
        EXPECT_EQ(matcher.stillArrived(pulse + 2ms + step).has_value(), i < 25) << i;
        (void)matcher.poll(pulse + 900ms);
    }
    EXPECT_EQ(matcher.counters().relearned, 0U)
        << "after such a step, the times would belong to other pulses";
}

TEST(StillMatcher, UnmatchedStillsWithDifferentOffsetsAreNotAClockStep) {
    StillMatcherOptions wide = fast();
    wide.wideWindow = 100ms;
    StillMatcher scattered(wide);
    scattered.pulseFired(kStart);
    ASSERT_TRUE(scattered.stillArrived(kStart + 100us));
    for (int i = 1; i < 200; ++i) {
        scattered.pulseFired(kStart + i * 1s);
        EXPECT_FALSE(scattered.stillArrived(kStart + i * 1s + milliseconds(3 + i * 13 % 90)));
    }
    EXPECT_EQ(scattered.counters().relearned, 0U);
}

TEST(StillMatcher, AbsurdTimesAreRefused) {
    StillMatcher matcher(fast());
    for (const std::int64_t edge : {std::int64_t{0}, kStart.ns}) {
        matcher.pulseFired({edge});
        for (const std::int64_t ns :
             {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max(),
              -kStart.ns, kStart.ns * 1000})
            EXPECT_FALSE(matcher.stillArrived({ns})) << ns;
    }
    EXPECT_TRUE(matcher.stillArrived(kStart));
}

TEST(StillMatcher, ImpossibleOptionsAreRefused) {
    const auto refused = [](auto change) {
        StillMatcherOptions options;
        change(options);
        EXPECT_THROW(StillMatcher{options}, std::invalid_argument);
    };
    refused([](auto& o) { o.window = 0ns; });
    refused([](auto& o) { o.wideWindow = -1ns; });
    refused([](auto& o) { o.timeout = 0ns; });
    refused([](auto& o) { o.timeout = 61min; });
    refused([](auto& o) { o.guess = -61min; });
    refused([](auto& o) { o.learnFrom = 0; });
}

TEST(StillMatcher, ManyPulsesWithoutStillsAreAllLost) {
    StillMatcher matcher({});
    for (int i = 0; i < 1000; ++i)
        matcher.pulseFired(kStart + i * 1ms);
    (void)matcher.poll(kStart + 1h);
    EXPECT_EQ(matcher.counters().lost, 1000U);
}

/// A simulated camera and trigger with every kind of fault. The true pulse of each still is known.
class Chaos {
public:
    explicit Chaos(unsigned seed) : random_(seed) {
        options_.guess = microseconds(pick(-2000, 2000));
        constant_ = options_.guess + microseconds(pick(-10000, 10000));
    }

    void run() {
        StillMatcher matcher(options_);
        for (int i = 0; i < 300; ++i) {
            now_ = now_ + microseconds(pick(60'000, 400'000));
            deliver(matcher, now_);
            fire(matcher, Pulse::Asked, i < 25);
        }
        deliver(matcher, now_ + 5s);
        check(matcher);
    }

private:
    struct Still {
        Timestamp arrival;
        Timestamp exposed;
        std::optional<Timestamp> pulse;  ///< empty: the still has no pulse
    };

    std::int64_t pick(std::int64_t from, std::int64_t to) {
        return std::uniform_int_distribution<std::int64_t>(from, to)(random_);
    }
    bool chance(int percent) { return pick(1, 100) <= percent; }

    void expose(Timestamp pulse, bool clean) {
        const Timestamp exposed = pulse + constant_ + nanoseconds(pick(-450'000, 450'000));
        const auto transfer = [&] {
            return microseconds(clean || chance(80) ? pick(500, 40'000) : pick(40'000, 900'000));
        };
        if (clean || !chance(15)) queue_.push_back({exposed + transfer(), exposed, pulse});
        if (clean) return;
        if (chance(5)) queue_.push_back({exposed + transfer(), exposed, std::nullopt});
        if (chance(10)) {
            const Timestamp stray = pulse + constant_ + microseconds(pick(3'000, 28'000));
            queue_.push_back({stray + transfer(), stray, std::nullopt});
        }
    }

    void fire(StillMatcher& matcher, Pulse kind, bool clean) {
        matcher.pulseFired(now_, kind);
        ++(kind == Pulse::Asked ? asked_ : repeated_);
        expose(now_, clean);
    }

    /// Delivers all stills that arrive up to the time `until`. Checks for lost pulses between
    /// deliveries.
    void deliver(StillMatcher& matcher, Timestamp until) {
        const Timestamp end = until;
        for (Timestamp t = lastPoll_ + 5ms; t <= end; t = t + 5ms) {
            lastPoll_ = t;
            std::ranges::sort(queue_, {}, &Still::arrival);
            while (!queue_.empty() && queue_.front().arrival <= t) {
                arrive(matcher, queue_.front());
                queue_.erase(queue_.begin());
            }
            const StillMatcher::Due due = matcher.poll(t);
            lost_ += due.lost;
            // Pulses must be at least 60 ms apart.
            if (due.repeat && t - now_ > 60ms && end - t > 60ms) {
                now_ = t;
                fire(matcher, Pulse::Repetition, false);
            }
        }
        now_ = end;
    }

    void arrive(StillMatcher& matcher, const Still& still) {
        const auto match = matcher.stillArrived(still.exposed);
        ++arrived_;
        if (!match) {
            EXPECT_TRUE(!still.pulse || given_.contains(still.pulse->ns))
                << "a still with a free pulse was refused";
            return;
        }
        EXPECT_TRUE(given_.insert(match->pulse.ns).second) << "a pulse got two stills";
        const std::int64_t off = (still.exposed - match->pulse).count() - constant_.count();
        EXPECT_LE(std::abs(off), 450'000) << "a still that belongs to no pulse was used";
        EXPECT_EQ(match->pulse, still.pulse.value_or(match->pulse))
            << "a still got the pulse of another still";
        EXPECT_LE(std::abs((match->exposed - match->pulse - constant_).count()), 450'000);
    }

    void check(const StillMatcher& matcher) const {
        const StillCounters& counted = matcher.counters();
        EXPECT_EQ(counted.fired, asked_ + repeated_);
        EXPECT_EQ(counted.matched + counted.unmatched, arrived_);
        EXPECT_EQ(counted.matched, given_.size());
        EXPECT_EQ(counted.lost, lost_);
        EXPECT_EQ(counted.fired, counted.matched - counted.late + counted.lost);
        EXPECT_EQ(counted.repeated, repeated_);
        EXPECT_LE(counted.repeated, counted.lost);
        EXPECT_GT(counted.repeated, 0U) << "no pulse was repeated in this run";
        EXPECT_GT(counted.late, 0U);
        EXPECT_EQ(counted.relearned, 0U);
    }

    std::mt19937 random_;
    StillMatcherOptions options_;
    nanoseconds constant_{};
    Timestamp now_ = kStart;
    Timestamp lastPoll_ = kStart;
    std::vector<Still> queue_;
    std::set<std::int64_t> given_;
    std::uint64_t asked_ = 0;
    std::uint64_t repeated_ = 0;
    std::uint64_t lost_ = 0;
    std::uint64_t arrived_ = 0;
};

TEST(StillMatcher, UnderRandomFaultsStillsKeepTheirPulsesAndCountsStayRight) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Chaos(seed).run();
        if (HasFailure()) break;
    }
}

}  // namespace
}  // namespace mfar
