#include "pipeline/simd/luma_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mfar::simd {
namespace {

std::vector<std::uint8_t> mixedTexels(std::size_t pixels) {
    std::vector<std::uint8_t> out(4 * pixels);
    std::uint32_t state = 1;
    for (std::uint8_t& value : out) {
        state = state * 1664525U + 1013904223U;
        value = static_cast<std::uint8_t>(state >> 24);
    }
    return out;
}

TEST(LumaRows, LumaMatchesRec601WithinAGreyLevelAtAnyLength) {
    for (const std::size_t pixels : {0UL, 1UL, 7UL, 16UL, 33UL, 100UL, 641UL}) {
        const std::vector<std::uint8_t> texels = mixedTexels(pixels);
        std::vector<std::uint8_t> luma(pixels + 1, 99);
        lumaRow(texels.data(), false, pixels, luma.data());
        for (std::size_t i = 0; i < pixels; ++i) {
            const double exact =
                0.299 * texels[4 * i] + 0.587 * texels[4 * i + 1] + 0.114 * texels[4 * i + 2];
            EXPECT_LE(std::abs(luma[i] - exact), 1.0) << i << " of " << pixels;
        }
        EXPECT_EQ(luma[pixels], 99) << "the kernel wrote past the row";
    }
}

TEST(LumaRows, WhiteStaysWhiteAndBlueCountsLeastInBothChannelOrders) {
    const std::vector<std::uint8_t> texels{255, 255, 255, 0, 0, 0, 255, 0};
    std::vector<std::uint8_t> luma(2);
    lumaRow(texels.data(), false, 2, luma.data());
    EXPECT_EQ(luma[0], 255);
    EXPECT_EQ(luma[1], 29);
    lumaRow(texels.data(), true, 2, luma.data());
    EXPECT_EQ(luma[1], 77);
}

}  // namespace
}  // namespace mfar::simd
