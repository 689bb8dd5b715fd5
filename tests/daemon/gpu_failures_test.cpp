#include "daemon/gpu_failures.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

using std::chrono::seconds;

const Timestamp kStart{1'000'000'000'000};

TEST(GpuFailures, WithoutAFailureNothingIsReported) {
    GpuFailures failures;
    EXPECT_EQ(failures.fault(kStart), std::nullopt);
    EXPECT_EQ(failures.banner(kStart), std::nullopt);
}

TEST(GpuFailures, OneFailureIsReportedForAMinuteButNotInThePicture) {
    GpuFailures failures;
    EXPECT_FALSE(failures.add(kStart, "reset"));
    EXPECT_EQ(failures.fault(kStart + seconds(60)), "the GPU failed and was restarted (reset)");
    EXPECT_EQ(failures.banner(kStart), std::nullopt);
    EXPECT_EQ(failures.fault(kStart + seconds(61)), std::nullopt);
}

TEST(GpuFailures, ThreeFailuresWithinAMinuteAreTooMany) {
    GpuFailures failures;
    EXPECT_FALSE(failures.add(kStart, "reset"));
    EXPECT_FALSE(failures.add(kStart + seconds(30), "reset"));
    EXPECT_TRUE(failures.add(kStart + seconds(60), "error 1"));
    const std::string said =
        "the GPU failed 3 times within a minute, so the CPU draws now (error 1)";
    EXPECT_EQ(failures.fault(kStart + seconds(60)), said);
    EXPECT_EQ(failures.banner(kStart + seconds(120)), said);
    EXPECT_EQ(failures.banner(kStart + seconds(121)), std::nullopt);
    EXPECT_EQ(failures.fault(kStart + seconds(1000)), said);
}

TEST(GpuFailures, ThreeFailuresInMoreThanAMinuteAreTolerated) {
    GpuFailures failures;
    for (int i = 0; i < 20; ++i)
        EXPECT_FALSE(failures.add(kStart + i * seconds(31), "reset")) << i;
}

}  // namespace
}  // namespace mfar
