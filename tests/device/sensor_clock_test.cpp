#include "hal/device/sensor_clock.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar {
namespace {

using namespace std::chrono_literals;

constexpr Timestamp kNow{500'000'000'000};

SensorClock::Now sleptFor(std::chrono::nanoseconds sleep, Timestamp now = kNow) {
    return {now, now + sleep};
}

TEST(SensorClock, MonotonicTimesStayAsTheyAre) {
    for (const auto sleep : {0ns, 3ns, 40'000'000ns, 86'400'000'000'000ns}) {
        SensorClock clock;
        EXPECT_EQ(clock.toMonotonic(kNow - 30ms, sleptFor(sleep)), kNow - 30ms);
        EXPECT_EQ(clock.kind(), SensorClock::Kind::Monotonic);
    }
}

TEST(SensorClock, TimesAheadOfTheMonotonicClockSelectTheBoottimeClock) {
    SensorClock clock;
    for (int i = 0; i < 20; ++i) {
        const Timestamp now = kNow + i * 33ms;
        EXPECT_EQ(clock.toMonotonic(now + 2h - 30ms, sleptFor(2h, now)), now - 30ms);
    }
    EXPECT_EQ(clock.kind(), SensorClock::Kind::Boottime);
    EXPECT_EQ(clock.toMonotonic(kNow + 5h - 30ms, sleptFor(5h)), kNow - 30ms)
        << "another suspend must not change the clock";
}

TEST(SensorClock, AShortSuspendCanBeDetectedByALaterFrame) {
    SensorClock clock;
    EXPECT_EQ(clock.toMonotonic(kNow + 20ms - 30ms, sleptFor(20ms)), kNow - 10ms)
        << "this short suspend cannot be detected from this frame";
    EXPECT_EQ(clock.toMonotonic(kNow + 20ms - 5ms, sleptFor(20ms)), kNow - 5ms);
    EXPECT_EQ(clock.kind(), SensorClock::Kind::Boottime);
}

TEST(SensorClock, LaterImplausibleTimesDoNotChangeTheClock) {
    SensorClock clock;
    for (int i = 0; i < 8; ++i)
        (void)clock.toMonotonic(kNow - 30ms, sleptFor(2h));
    EXPECT_FALSE(clock.toMonotonic(kNow + 2h - 30ms, sleptFor(2h)));
    EXPECT_EQ(clock.kind(), SensorClock::Kind::Monotonic);
}

TEST(SensorClock, ImplausibleTimesAreRefused) {
    SensorClock clock;
    for (const Timestamp stamp :
         {Timestamp{0}, Timestamp{-1}, kNow + 1ms, kNow - 11s, Timestamp{1'700'000'000'000'000'000},
          Timestamp{std::numeric_limits<std::int64_t>::min()},
          Timestamp{std::numeric_limits<std::int64_t>::max()}})
        EXPECT_FALSE(clock.toMonotonic(stamp, sleptFor(0ns))) << stamp.ns;
}

TEST(SensorClock, TheBoottimeClockIsNotBehindTheMonotonicClock) {
    const SensorClock::Now now = SensorClock::Now::read();
    EXPECT_LE(now.monotonic, Timestamp::now());
    EXPECT_GE(now.boottime - now.monotonic, -1s);
}

}  // namespace
}  // namespace mfar
