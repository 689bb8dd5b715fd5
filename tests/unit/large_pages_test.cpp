#include "base/large_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
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

}  // namespace
}  // namespace mfar
