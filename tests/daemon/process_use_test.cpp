#include "daemon/process_use.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>
#include <vector>

namespace mfar {
namespace {

TEST(ProcessUse, WallTimeIncreases) {
    const ProcessUse before = processUse();
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    // The kernel measures the time since a process's start in steps of 10 ms.
    EXPECT_GE(processUse().ms - before.ms, 40);
    EXPECT_GE(before.ms, 0);
}

TEST(ProcessUse, ProcessorTimeOfAllThreadsCounts) {
    constexpr double kUsedMs = 30;
    const ProcessUse before = processUse();
    const std::clock_t start = std::clock();
    const auto usedMs = [&] { return 1000.0 * (std::clock() - start) / CLOCKS_PER_SEC; };
    std::jthread([&] {
        while (usedMs() < kUsedMs) {
        }
    }).join();
    const double counted = processUse().cpuMs - before.cpuMs;
    EXPECT_GT(before.cpuMs, 0);
    EXPECT_GE(counted, kUsedMs - 1);
    EXPECT_LE(counted, usedMs() + 1);
}

TEST(ProcessUse, MemoryCountsAsUsedOnceItIsWritten) {
    const ProcessUse before = processUse();
    EXPECT_GT(before.residentMb, 0);
    const std::vector<char> memory(64'000'000, 'a');
    EXPECT_GT(processUse().residentMb - before.residentMb, 50) << memory.back();
}

}  // namespace
}  // namespace mfar
