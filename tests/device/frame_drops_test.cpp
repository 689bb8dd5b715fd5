#include "hal/frame_drops.h"

#include <gtest/gtest.h>

#include <random>

namespace mfar {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::nanoseconds kPeriod{33'333'333};

TEST(FrameDrops, EveryGapIsCounted) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> jitter(-4'000'000, 4'000'000);
        std::uniform_int_distribution<int> percent(0, 99);
        FrameDrops drops;
        Timestamp ideal{1'000'000'000};
        std::uint64_t missing = 0;
        for (int i = 0; i < 1000; ++i) {
            const int gap = i >= 10 && percent(random) < 5 ? 1 + percent(random) % 7 : 0;
            ideal = ideal + kPeriod * (1 + gap);
            EXPECT_EQ(drops.add(ideal + std::chrono::nanoseconds(jitter(random))), gap) << i;
            missing += static_cast<std::uint64_t>(gap);
        }
        EXPECT_EQ(drops.dropped(), missing);
    }
}

TEST(FrameDrops, NothingIsCountedBeforeThePeriodIsKnown) {
    FrameDrops drops;
    Timestamp time{0};
    for (int i = 0; i < 8; ++i)
        EXPECT_EQ(drops.add(time = time + kPeriod * (1 + i % 3)), 0);
    EXPECT_FALSE(drops.period());
}

TEST(FrameDrops, AChangedFrameRateIsLearned) {
    FrameDrops drops;
    Timestamp time{0};
    for (int i = 0; i < 40; ++i)
        drops.add(time = time + kPeriod);
    for (int i = 0; i < 40; ++i)
        drops.add(time = time + 2 * kPeriod);
    const std::uint64_t before = drops.dropped();
    for (int i = 0; i < 40; ++i)
        drops.add(time = time + 2 * kPeriod);
    EXPECT_EQ(drops.dropped(), before);
    EXPECT_EQ(drops.period(), 2 * kPeriod);
}

TEST(FrameDrops, WithFrameNumbersDropsAreCountedExactlyAtAnyRate) {
    for (const auto period : {kPeriod, 2 * kPeriod, 5 * kPeriod}) {
        FrameDrops drops;
        Timestamp time{0};
        std::uint32_t number = 4294967290;  // the sixth frame has the number 0
        for (int i = 0; i < 100; ++i) {
            const int gap = i > 0 && i % 7 == 0 ? i % 5 : 0;
            time = time + period * (1 + gap);
            number += static_cast<std::uint32_t>(1 + gap);
            EXPECT_EQ(drops.add(time, number), gap) << i;
        }
    }
}

TEST(FrameDrops, AtACounterResetGapsInTimeAreCounted) {
    FrameDrops drops;
    Timestamp time{0};
    std::uint32_t number = 50000;
    for (int i = 0; i < 40; ++i)
        EXPECT_EQ(drops.add(time = time + kPeriod, number++), 0);
    EXPECT_EQ(drops.add(time = time + kPeriod, 0), 0)
        << "a counter reset without a gap in time is not a drop";
    EXPECT_EQ(drops.add(time = time + kPeriod, 1), 0);
    EXPECT_EQ(drops.add(time = time + 3 * kPeriod, 0), 2)
        << "at a counter reset, the gap in time must be counted";
    EXPECT_EQ(drops.add(time = time + kPeriod, 5000), 0)
        << "a jump of the number without a gap in time is not a drop";
    EXPECT_EQ(drops.add(time = time + kPeriod, 5000), 0) << "a repeated number is not a drop";
    EXPECT_EQ(drops.add(time = time + 2 * kPeriod, 5000), 1);
    EXPECT_EQ(drops.add(time = time + 2 * kPeriod), 1)
        << "without a number, the gap in time must be counted";
}

TEST(FrameDrops, BrokenFramesDoNotCountAsDrops) {
    for (const bool numbered : {true, false}) {
        FrameDrops drops;
        Timestamp time{0};
        std::uint32_t number = 0;
        const auto next = [&] {
            return numbered ? std::optional(number++) : std::optional<std::uint32_t>{};
        };
        for (int i = 0; i < 100; ++i) {
            time = time + kPeriod;
            if (i % 9 == 8)
                EXPECT_EQ(drops.addUntimed(next()), 0);
            else
                EXPECT_EQ(drops.add(time, next()), 0) << i;
        }
        number += 3;
        EXPECT_EQ(drops.addUntimed(next()), numbered ? 3 : 0);
        EXPECT_EQ(drops.add(time + 5 * kPeriod, next()), numbered ? 0 : 3)
            << "each missing frame must be counted once";
        EXPECT_EQ(drops.dropped(), 3U);
    }
}

TEST(FrameDrops, PausesAndNonIncreasingTimesAreNotDrops) {
    FrameDrops drops;
    Timestamp time{0};
    for (int i = 0; i < 40; ++i)
        drops.add(time = time + kPeriod);
    drops.pause();
    EXPECT_EQ(drops.add(time = time + 10s), 0);
    EXPECT_EQ(drops.add(time), 0);
    EXPECT_EQ(drops.add(time = time - 5s), 0);
    EXPECT_EQ(drops.add(time = time + kPeriod), 0);
    EXPECT_EQ(drops.add(time = time + 2 * kPeriod), 1);
    EXPECT_EQ(drops.dropped(), 1U);
}

}  // namespace
}  // namespace mfar
