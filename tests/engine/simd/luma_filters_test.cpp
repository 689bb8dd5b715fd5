#include "pipeline/simd/luma_filters.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace mfar::simd {
namespace {

using Bytes = std::vector<std::uint8_t>;
using test::kLengths;

Bytes bytes(std::size_t count, unsigned seed) {
    return test::randomValues<std::uint8_t>(count, 0, 255.9, seed);
}

TEST(LumaFilters, HalvedRowsAreMeansOfFourPixels) {
    for (const std::size_t width : kLengths) {
        const Bytes a = bytes(2 * width, 1), b = bytes(2 * width, 2);
        Bytes out(width + 1, 99);
        halveRow(a.data(), b.data(), width, out.data());
        for (std::size_t x = 0; x < width; ++x)
            ASSERT_EQ(out[x], (a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) / 4);
        EXPECT_EQ(out[width], 99) << "the kernel wrote past the row";
    }
}

TEST(LumaFilters, ThinnedRowsContainEverySecondByte) {
    for (const std::size_t width : kLengths) {
        const Bytes in = bytes(2 * width - 1, 3);
        Bytes out(width + 1, 99);
        thinRow(in.data(), width, out.data());
        for (std::size_t x = 0; x < width; ++x)
            ASSERT_EQ(out[x], in[2 * x]);
        EXPECT_EQ(out[width], 99) << "the kernel wrote past the row";
    }
}

TEST(LumaFilters, SmoothedRowsApplyTheTapsInBothDirections) {
    for (const std::size_t width : {1UL, 2UL, 5UL, 255UL, 256UL, 257UL, 600UL}) {
        for (const int side : {0, 20, 64, 85}) {
            const Bytes a = bytes(width, 4), b = bytes(width, 5), c = bytes(width, 6);
            Bytes out(width);
            smoothRow(a.data(), b.data(), c.data(), width, side, out.data());
            const auto column = [&](std::ptrdiff_t x) {
                x = std::clamp<std::ptrdiff_t>(x, 0, static_cast<std::ptrdiff_t>(width) - 1);
                return side * (a[x] + c[x]) + (256 - 2 * side) * b[x];
            };
            for (std::ptrdiff_t x = 0; x < static_cast<std::ptrdiff_t>(width); ++x) {
                const int sum =
                    side * (column(x - 1) + column(x + 1)) + (256 - 2 * side) * column(x) + 32768;
                ASSERT_EQ(out[x], sum >> 16) << x << " of " << width;
            }
        }
    }
}

TEST(LumaFilters, NoiseColumnsAreSumsOfAbsoluteResponsesToTheNoiseMask) {
    constexpr Size kSize{140, 18};
    for (const bool extreme : {false, true}) {
        Bytes picture = bytes(140UL * 18, 7);
        if (extreme)
            for (std::size_t i = 0; i < picture.size(); ++i)
                picture[i] = (i % 140 + i / 140) % 2 == 0 ? 0 : 255;
        std::vector<std::uint16_t> sums(138);
        noiseColumns({picture.data(), 140, kSize}, 1, 16, sums.size(), sums.data());
        for (int x = 1; x < 139; ++x) {
            int expected = 0;
            for (int y = 1; y <= 16; ++y) {
                const auto at = [&](int u, int v) { return picture[(y + v) * 140 + x + u]; };
                expected += std::abs(at(-1, -1) + at(1, -1) + at(-1, 1) + at(1, 1) + 4 * at(0, 0) -
                                     2 * (at(0, -1) + at(-1, 0) + at(1, 0) + at(0, 1)));
            }
            ASSERT_EQ(sums[x - 1], expected) << x;
        }
    }
}

TEST(LumaFilters, WeightedRowsAreSummed) {
    for (const std::size_t count : kLengths) {
        const Bytes in = bytes(count, 8);
        std::vector<float> sums(count + 1, 3);
        addWeighted(in.data(), 0.25F, count, sums.data());
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_FLOAT_EQ(sums[i], 3 + 0.25F * in[i]);
        EXPECT_EQ(sums[count], 3);
    }
}

}  // namespace
}  // namespace mfar::simd
