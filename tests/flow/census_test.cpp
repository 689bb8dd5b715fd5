#include "pipeline/epipolar/census.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <random>

namespace mfar {
namespace {

LumaImage randomPicture(Size size, int least, int greatest, unsigned seed) {
    LumaImage out(size);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> grey(least, greatest);
    for (std::uint8_t& p : out.pixels)
        p = static_cast<std::uint8_t>(grey(random));
    return out;
}

std::vector<std::uint32_t> censusOf(const LumaImage& picture) {
    std::vector<std::uint32_t> out(picture.pixels.size(), 0xFFFFFFFFU);
    census(picture, 0, picture.size.height, out);
    return out;
}

/// Oracle: compares the neighbours row by row from the top left. The first neighbour sets the
/// highest bit.
std::uint32_t twin(const LumaImage& picture, int x, int y) {
    const auto at = [&](int i, int j) {
        return picture.row(
            std::clamp(j, 0, picture.size.height - 1))[std::clamp(i, 0, picture.size.width - 1)];
    };
    std::uint32_t bits = 0;
    for (int j = -2; j <= 2; ++j)
        for (int i = -2; i <= 2; ++i)
            if (i != 0 || j != 0) bits = 2 * bits + (at(x + i, y + j) < at(x, y) ? 1 : 0);
    return bits;
}

TEST(Census, MatchesTheOracleAtEverySize) {
    for (const Size size :
         {Size{1, 1}, Size{1, 9}, Size{9, 1}, Size{2, 2}, Size{3, 4}, Size{16, 16}, Size{33, 21}}) {
        const LumaImage picture = randomPicture(size, 0, 255, 3);
        const auto bits = censusOf(picture);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                ASSERT_EQ(bits[static_cast<std::size_t>(y) * size.width + x], twin(picture, x, y))
                    << x << ',' << y << " of " << size.width << 'x' << size.height;
    }
}

TEST(Census, EachDarkNeighbourSetsItsOwnBit) {
    LumaImage picture({9, 9});
    std::fill(picture.pixels.begin(), picture.pixels.end(), std::uint8_t{100});
    picture.row(2)[2] = 50;
    picture.row(6)[6] = 50;
    picture.row(4)[5] = 50;
    EXPECT_EQ(censusOf(picture)[9 * 4 + 4], 1U << 23 | 1U << 11 | 1U);
}

TEST(Census, EveryBitIsUsedExceptTheMarkOfPixelsWithoutCensus) {
    const LumaImage picture = randomPicture({40, 30}, 0, 255, 5);
    std::uint32_t all = 0;
    for (const std::uint32_t bits : censusOf(picture))
        all |= bits;
    EXPECT_EQ(all, (1U << kCensusBits) - 1);
    EXPECT_EQ(all & kNoCensus, 0U);
}

TEST(Census, ConstantPicturesGiveZero) {
    for (const int grey : {0, 128, 255})
        for (const std::uint32_t bits : censusOf(randomPicture({17, 5}, grey, grey, 1)))
            ASSERT_EQ(bits, 0U);
}

LumaImage toned(LumaImage picture, const std::function<double(double)>& curve) {
    for (std::uint8_t& p : picture.pixels)
        p = static_cast<std::uint8_t>(std::lround(curve(p)));
    return picture;
}

// The picture has fifty grey levels, so that each of these curves keeps neighbouring levels
// distinct.
TEST(Census, IsInvariantToRisingToneCurves) {
    const LumaImage picture = randomPicture({31, 23}, 100, 149, 9);
    const auto bits = censusOf(picture);
    const std::function<double(double)> curves[] = {
        [](double v) { return v - 100; },
        [](double v) { return v + 106; },
        [](double v) { return 5 * (v - 100); },
        [](double v) { return 255 * std::sqrt((v - 100) / 49); },
        [](double v) { return 255 * std::pow((v - 100) / 49, 1.2); },
    };
    for (const auto& curve : curves)
        EXPECT_EQ(censusOf(toned(picture, curve)), bits);
    EXPECT_NE(censusOf(toned(picture, [](double v) { return 255 - v; })), bits);
}

// If a curve makes neighbouring grey levels equal, this clears bits of the census but sets none.
TEST(Census, FlatterToneCurvesCanClearBitsButSetNone) {
    const LumaImage picture = randomPicture({31, 23}, 0, 255, 9);
    const auto bits = censusOf(picture);
    const auto flat = censusOf(toned(picture, [](double v) { return 100 + v / 5; }));
    int gone = 0;
    for (std::size_t i = 0; i < bits.size(); ++i) {
        ASSERT_EQ(flat[i] & ~bits[i], 0U);
        gone += std::popcount(bits[i] & ~flat[i]);
    }
    EXPECT_GT(gone, 0);
}

TEST(Census, RowsComputedSeparatelyGiveTheSameCensus) {
    const LumaImage picture = randomPicture({19, 14}, 0, 255, 11);
    const auto whole = censusOf(picture);
    std::vector<std::uint32_t> parts(picture.pixels.size(), 0xFFFFFFFFU);
    census(picture, 5, 6, parts);
    for (std::size_t i = 0; i < parts.size(); ++i)
        ASSERT_EQ(parts[i], i / 19 == 5 ? whole[i] : 0xFFFFFFFFU);
    census(picture, 6, 14, parts);
    census(picture, 0, 5, parts);
    EXPECT_EQ(parts, whole);
}

}  // namespace
}  // namespace mfar
