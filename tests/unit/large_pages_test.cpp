#include "base/large_pages.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mfar {
namespace {

TEST(LargePages, TheMemoryAndItsNeighboursKeepTheirContent) {
    std::vector<std::uint8_t> memory(5U << 20U, 7);
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{1}, memory.size() - 3}) {
        preferLargePages(memory.data() + 1, bytes);
        EXPECT_TRUE(std::ranges::all_of(memory, [](std::uint8_t v) { return v == 7; })) << bytes;
    }
    preferLargePages(nullptr, 0);
}

TEST(LargePages, MemoryIsZeroedAndStartsAtALargePage) {
    LargePages pages(LargePages::kPage + 1);
    ASSERT_EQ(pages.size(), 2 * LargePages::kPage);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(pages.data()) % LargePages::kPage, 0U);
    const auto isZero = [](std::byte v) { return v == std::byte{0}; };
    EXPECT_TRUE(std::all_of(pages.data(), pages.data() + pages.size(), isZero));
    pages.data()[pages.size() - 1] = std::byte{7};
    LargePages moved(std::move(pages));
    EXPECT_EQ(moved.data()[moved.size() - 1], std::byte{7});
    LargePages other(1);
    other = std::move(moved);
    EXPECT_EQ(other.data()[other.size() - 1], std::byte{7});
}

TEST(LargePages, ProvidedPagesKeepTheirContentAndCauseNoPageFaults) {
    const auto faults = [] {
        rusage usage{};
        getrusage(RUSAGE_THREAD, &usage);
        return usage.ru_minflt;
    };
    LargePages pages(4 * LargePages::kPage);
    pages.data()[0] = std::byte{7};
    pages.provide();
    EXPECT_EQ(pages.data()[0], std::byte{7});
    const long before = faults();
    for (std::size_t i = 0; i < pages.size(); i += 512)
        pages.data()[i] = std::byte{1};
    EXPECT_LE(faults() - before, 2);
}

}  // namespace
}  // namespace mfar
