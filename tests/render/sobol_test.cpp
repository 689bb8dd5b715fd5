#include "pipeline/render/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace mfar {
namespace {

/// Oracle of the second Sobol coordinate. Its direction numbers are the rows of Pascal's triangle
/// modulo 2.
std::uint32_t secondCoordinate(std::uint32_t index) {
    std::uint32_t out = 0, direction = 0x80000000U;
    for (; index != 0; index >>= 1, direction ^= direction >> 1)
        if ((index & 1U) != 0) out ^= direction;
    return out;
}

TEST(Sobol, CoordinatesMatchTheDirectionNumbers) {
    for (std::uint32_t i = 0; i < 5000; i += 7) {
        const auto [x, y] = sobolReversed(i * 859U);
        EXPECT_EQ(x, i * 859U);
        EXPECT_EQ(reversedBits(y), secondCoordinate(i * 859U));
    }
}

TEST(Sobol, ShuffleKeepsIndicesOfAnAlignedBlockTogether) {
    for (const std::uint32_t seed : {1U, 77U, 0xDEADBEEFU}) {
        std::set<std::uint32_t> seen;
        for (std::uint32_t i = 48; i < 64; ++i)
            seen.insert(shuffledIndex(i, seed));
        EXPECT_EQ(seen.size(), 16U);
        EXPECT_EQ(*seen.begin() / 16, *seen.rbegin() / 16);
    }
}

/// True if each box of 2^-a by 2^-b contains exactly one of 2^(a + b) samples from `first` on.
bool eachBoxHasOne(std::uint32_t pixel, std::uint32_t dimension, std::uint32_t first, int a,
                   int b) {
    std::set<std::pair<int, int>> boxes;
    const std::uint32_t count = 1U << (a + b);
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Eigen::Vector2f u = PixelSampler(3, pixel, i, false).pair(dimension);
        boxes.emplace(static_cast<int>(std::ldexp(u.x(), a)),
                      static_cast<int>(std::ldexp(u.y(), b)));
    }
    return boxes.size() == count;
}

TEST(Sobol, EveryElementaryIntervalOfEveryBlockHoldsOneSample) {
    for (const std::uint32_t pixel : {0U, 5U, 307199U})
        for (const std::uint32_t dimension : {0U, 1U, 9U})
            for (int bits = 0; bits <= 8; ++bits)
                for (int a = 0; a <= bits; ++a)
                    for (const std::uint32_t block : {0U, 1U, 6U})
                        EXPECT_TRUE(eachBoxHasOne(pixel, dimension, block << bits, a, bits - a))
                            << pixel << ' ' << dimension << ' ' << a << ' ' << bits - a;
}

/// Root mean square, over pixels, of the error of the mean of f(u) over n samples. The integral of
/// f is known.
template <typename F>
double errorOf(F f, double integral, std::uint32_t n, bool independent) {
    double squares = 0;
    constexpr std::uint32_t kPixels = 256;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        double sum = 0;
        for (std::uint32_t i = 0; i < n; ++i)
            sum += f(PixelSampler(1, pixel, i, independent).pair(2));
        squares += (sum / n - integral) * (sum / n - integral);
    }
    return std::sqrt(squares / kPixels);
}

TEST(Sobol, SmoothIntegralsHaveFarSmallerErrorsThanWithRandomNumbers) {
    const auto product = [](const Eigen::Vector2f& u) { return std::exp(u.x()) * u.y(); };
    const double integral = 0.5 * (std::exp(1.0) - 1);
    const double ours = errorOf(product, integral, 64, false);
    const double chance = errorOf(product, integral, 64, true);
    EXPECT_LT(ours * 15, chance);
    // The error of 64 independent samples is the standard deviation of product(), divided by
    // sqrt(64).
    EXPECT_NEAR(chance, 0.572 / 8, 0.004);
}

TEST(Sobol, ErrorOfADiscsAreaFallsFasterThanWithRandomNumbers) {
    const auto disc = [](const Eigen::Vector2f& u) { return u.squaredNorm() < 1 ? 1.0 : 0.0; };
    const double few = errorOf(disc, M_PI / 4, 16, false);
    const double many = errorOf(disc, M_PI / 4, 1024, false);
    // An error of n^-3/4 falls by a factor of 22.6, the error of random numbers by 8.
    EXPECT_GT(few / many, 14);
}

TEST(Sobol, DimensionsAndPixelsAreUncorrelated) {
    double product = 0, sum = 0;
    constexpr int kPairs = 20000;
    for (std::uint32_t i = 0; i < kPairs; ++i) {
        const PixelSampler sampler(9, i, 0, false);
        product += (sampler.pair(0).x() - 0.5) * (sampler.pair(1).x() - 0.5);
        sum += sampler.pair(0).y();
    }
    EXPECT_NEAR(product / kPairs, 0, 5 / 12.0 / std::sqrt(kPairs));
    EXPECT_NEAR(sum / kPairs, 0.5, 5 * 0.289 / std::sqrt(kPairs));
}

}  // namespace
}  // namespace mfar
