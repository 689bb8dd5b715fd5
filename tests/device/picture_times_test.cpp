#include "hal/device/picture_times.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

using namespace std::chrono_literals;

constexpr SensorClock::Now kArrived{{500'000'000'000}, {500'000'000'000}};
constexpr std::size_t kWhole = 1000;

PictureTimes::Reported reported(std::uint32_t sequence, std::chrono::nanoseconds age) {
    PictureTimes::Reported out;
    out.bytes = kWhole;
    out.sequence = sequence;
    out.stamp = (kArrived.monotonic - age).ns;
    return out;
}

TEST(PictureTimes, TheTimeOfAPictureIsTheMiddleOfItsExposure) {
    PictureTimes times(kWhole, 30);
    PictureTimes::Reported picture = reported(0, 40ms);
    picture.exposure = 10ms;
    EXPECT_EQ(times.add(picture, kArrived), kArrived.monotonic - 35ms);
}

TEST(PictureTimes, APictureWithoutTimeStampGetsItsTimeOfArrivalAndIsCounted) {
    PictureTimes times(kWhole, 30);
    PictureTimes::Reported picture = reported(0, 0ms);
    picture.stamp = 0;
    picture.exposure = 10ms;
    EXPECT_EQ(times.add(picture, kArrived), kArrived.monotonic);
    EXPECT_EQ(times.counters().untimed, 1U);
}

TEST(PictureTimes, UnusablePicturesAreCountedByTheirCause) {
    PictureTimes times(kWhole, 30);
    EXPECT_TRUE(times.add(reported(0, 40ms), kArrived));
    PictureTimes::Reported startup = reported(1, 30ms), failed = startup, truncated = startup;
    startup.isStartup = startup.failed = true;
    failed.failed = true;
    truncated.bytes = kWhole - 1;
    for (const PictureTimes::Reported& picture : {startup, failed, truncated})
        EXPECT_FALSE(times.add(picture, kArrived));
    EXPECT_FALSE(times.add(reported(2, 40ms), kArrived))
        << "the time is not later than that of the previous picture";
    EXPECT_FALSE(times.add(reported(3, -1s), kArrived)) << "the time is in the future";
    EXPECT_TRUE(times.add(reported(4, 20ms), kArrived));
    EXPECT_EQ(times.counters().startup, 1U);
    EXPECT_EQ(times.counters().broken, 2U);
    EXPECT_EQ(times.counters().badTimes, 2U);
    EXPECT_EQ(times.counters().untimed, 0U);
}

TEST(PictureTimes, MissingSequenceNumbersCountAsDropsEvenNextToUnusablePictures) {
    PictureTimes times(kWhole, 30);
    EXPECT_TRUE(times.add(reported(0, 400ms), kArrived));
    PictureTimes::Reported broken = reported(2, 300ms);
    broken.failed = true;
    EXPECT_FALSE(times.add(broken, kArrived));
    EXPECT_FALSE(times.add(reported(4, -1s), kArrived));
    EXPECT_TRUE(times.add(reported(5, 200ms), kArrived));
    EXPECT_EQ(times.dropped(), 2U) << "numbers 1 and 3 are missing";
}

}  // namespace
}  // namespace mfar
