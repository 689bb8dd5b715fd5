#include "base/rows.h"
#include "base/zeroed_array.h"
#include "hal/frame.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <utility>

namespace mfar {
namespace {

constexpr std::size_t kMany = 64U << 20U;

std::size_t residentBytes() {
    std::size_t all = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t grownSince(std::size_t before) {
    const std::size_t now = residentBytes();
    return now > before ? now - before : 0;
}

TEST(ZeroedArray, ContentIsZeroAndAlignedAtEverySize) {
    for (const std::size_t size : {0, 1, 63, 64, 65, 4095, 1 << 20}) {
        // Fills a block of memory with a value other than 0 and frees it. Below, the same block is
        // usually allocated again.
        std::fill_n(ZeroedArray<std::uint8_t>(size).data(), size, std::uint8_t{0xA5});
        ZeroedArray<std::uint8_t> array(size);
        ASSERT_EQ(array.size(), size);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % array.kAlignment, 0U);
        EXPECT_EQ(std::count(array.data(), array.data() + size, 0), static_cast<long>(size));
        std::fill_n(array.data(), size, std::uint8_t{1});
    }
}

TEST(ZeroedArray, MovingKeepsTheMemory) {
    ZeroedArray<int> a(10);
    a.data()[9] = 5;
    const int* const memory = a.data();
    ZeroedArray<int> b(std::move(a));
    EXPECT_EQ(b.data(), memory);
    ZeroedArray<int> c(3);
    c = std::move(b);
    EXPECT_EQ(c.data(), memory);
    EXPECT_EQ(c.size(), 10U);
    EXPECT_EQ(c.data()[9], 5);
}

TEST(ZeroedArray, OnlyUsedPartsTakeMemory) {
    const std::size_t before = residentBytes();
    ASSERT_GT(before, 0U);
    ZeroedArray<std::uint8_t> array(kMany);
    EXPECT_LT(grownSince(before), kMany / 2);
    std::fill_n(array.data(), kMany, std::uint8_t{1});
    EXPECT_GT(grownSince(before), kMany / 2);
}

TEST(ZeroedArray, UnusedRowsTakeNoMemory) {
    const std::size_t before = residentBytes();
    const AlignedRows<std::uint32_t> rows({4096, 4096});
    EXPECT_LT(grownSince(before), kMany / 2);
    EXPECT_EQ(rows[4095][4095], 0U);
}

TEST(ZeroedArray, BuffersOfAPoolThatWereNeverLentTakeNoMemory) {
    const std::size_t before = residentBytes();
    FramePool pool({2048, 2048}, PixelFormat::Rgba8, 4);
    const auto slot = pool.acquire(std::chrono::milliseconds(0));
    ASSERT_TRUE(slot.has_value());
    std::fill_n(slot->data, 2048 * slot->stride, std::uint8_t{1});
    EXPECT_LT(grownSince(before), kMany / 2);
}

}  // namespace
}  // namespace mfar
