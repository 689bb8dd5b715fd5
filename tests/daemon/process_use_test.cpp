#include "daemon/process_use.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace mfar {
namespace {

TEST(ProcessUse, WallTimeIncreasesAndProcessorTimeDoesNotDecrease) {
    const ProcessUse before = processUse();
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    const ProcessUse after = processUse();
    // The kernel measures the time since a process's start in steps of 10 ms.
    EXPECT_GE(after.ms - before.ms, 40);
    EXPECT_GE(before.ms, 0);
    EXPECT_GT(before.cpuMs, 0);
    EXPECT_GE(after.cpuMs, before.cpuMs);
}

TEST(ProcessUse, MemoryCountsAsUsedOnceItIsWritten) {
    const ProcessUse before = processUse();
    EXPECT_GT(before.residentMb, 0);
    const std::vector<char> memory(64'000'000, 'a');
    EXPECT_GT(processUse().residentMb - before.residentMb, 50) << memory.back();
}

}  // namespace
}  // namespace mfar
