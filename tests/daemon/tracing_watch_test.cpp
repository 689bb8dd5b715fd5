#include "daemon/tracing_watch.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Timestamp kStart{1'000'000'000'000};

RenderCounters counters(std::uint64_t shown, double cpuMs) {
    RenderCounters out;
    out.shown = shown;
    out.cpuMs = cpuMs;
    return out;
}

TEST(TracingWatch, WarnsOnceIfObjectsStayWithoutAPicture) {
    TracingWatch watch(8);
    EXPECT_EQ(watch.add(true, counters(0, 100), kStart), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(0, 103), kStart + milliseconds(4999)), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(0, 105), kStart + seconds(5)),
              "virtual objects were in view in 3 frames but are not shown, because the path tracer "
              "has no picture of them yet; it got 5 of 48 ms of processor time (its priority is "
              "low, so other load delays it)");
    EXPECT_EQ(watch.add(true, counters(0, 105), kStart + seconds(20)), std::nullopt);
    EXPECT_EQ(watch.atEnd(), std::nullopt);
}

TEST(TracingWatch, TheWaitBeginsWhenObjectsComeIntoView) {
    TracingWatch watch(8);
    EXPECT_EQ(watch.add(false, counters(0, 0), kStart), std::nullopt);
    EXPECT_EQ(watch.add(false, counters(0, 0), kStart + seconds(60)), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(0, 0), kStart + seconds(61)), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(0, 0), kStart + seconds(65)), std::nullopt);
    EXPECT_NE(watch.add(true, counters(0, 0), kStart + seconds(66)), std::nullopt);
}

TEST(TracingWatch, TheWaitBeginsAnewAfterObjectsWereOutOfView) {
    TracingWatch watch(8);
    EXPECT_EQ(watch.add(true, counters(0, 0), kStart), std::nullopt);
    EXPECT_EQ(watch.add(false, counters(0, 1), kStart + seconds(1)), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(0, 2), kStart + seconds(6)), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(0, 3), kStart + seconds(10)), std::nullopt);
    EXPECT_NE(watch.add(true, counters(0, 4), kStart + seconds(11)), std::nullopt);
}

TEST(TracingWatch, APictureEndsTheWatch) {
    TracingWatch watch(8);
    EXPECT_EQ(watch.add(true, counters(0, 0), kStart), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(1, 30), kStart + seconds(1)), std::nullopt);
    EXPECT_EQ(watch.add(true, counters(1, 30), kStart + seconds(60)), std::nullopt);
    EXPECT_EQ(watch.atEnd(), std::nullopt);
}

TEST(TracingWatch, AShortRunWithoutAPictureGivesAWarningAtItsEnd) {
    TracingWatch watch(8);
    EXPECT_EQ(watch.atEnd(), std::nullopt);
    TracingWatch seen(8);
    EXPECT_EQ(seen.add(true, counters(0, 0), kStart), std::nullopt);
    EXPECT_NE(seen.atEnd(), std::nullopt);
    EXPECT_EQ(seen.atEnd(), std::nullopt);
}

}  // namespace
}  // namespace mfar
