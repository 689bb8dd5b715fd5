#include "pipeline/epipolar/field_filters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace mfar {
namespace {

constexpr Size kSizes[] = {{1, 1}, {1, 2}, {2, 1},  {1, 7},  {7, 1},
                           {2, 2}, {3, 3}, {16, 5}, {33, 40}};

std::vector<float> randomField(Size size, int values) {
    std::mt19937 random(values);
    std::uniform_int_distribution<int> value(-values, values);
    std::vector<float> out(static_cast<std::size_t>(size.width) * size.height);
    for (float& v : out)
        v = 0.25F * static_cast<float>(value(random));
    return out;
}

float clampedAt(const std::vector<float>& field, Size size, int x, int y) {
    return field[static_cast<std::size_t>(std::clamp(y, 0, size.height - 1)) * size.width +
                 std::clamp(x, 0, size.width - 1)];
}

float medianAt(const std::vector<float>& field, Size size, int x, int y) {
    std::vector<float> around;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
            around.push_back(clampedAt(field, size, x + i, y + j));
    std::sort(around.begin(), around.end());
    return around[4];
}

// A small number of different values causes many ties.
TEST(Median3x3, TheMedianIsTheFifthOfNineSortedValues) {
    for (int threads = 1; threads <= 3; ++threads) {
        Workers workers(threads);
        for (const Size size : kSizes) {
            for (const int values : {1, 3, 1000}) {
                const auto in = randomField(size, values);
                std::vector<float> out(in.size(), std::numeric_limits<float>::quiet_NaN());
                median3x3(in, size, workers, out);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(out[static_cast<std::size_t>(y) * size.width + x],
                                  medianAt(in, size, x, y))
                            << x << ',' << y << " of " << size.width << 'x' << size.height;
            }
        }
    }
}

// Tests random orders of nine distinct values, because a wrong sorting network fails only for some
// orders.
TEST(Median3x3, TheMedianDoesNotDependOnTheOrderOfValues) {
    Workers workers(1);
    std::vector<float> in{1, 2, 3, 4, 5, 6, 7, 8, 9}, out(9);
    std::mt19937 random(5);
    for (int round = 0; round < 5000; ++round) {
        std::shuffle(in.begin(), in.end(), random);
        median3x3(in, {3, 3}, workers, out);
        ASSERT_EQ(out[4], 5);
    }
}

TEST(LocalRange, TheRangeIsTheSmallestAndLargestValueOfASquare) {
    for (const Size size : kSizes) {
        for (const int radius : {0, 1, 2, 5}) {
            const auto in = randomField(size, 50);
            LocalRange range;
            localRange(in, size, radius, range);
            ASSERT_EQ(range.low.size(), in.size());
            ASSERT_EQ(range.high.size(), in.size());
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    float low = clampedAt(in, size, x, y), high = low;
                    for (int j = -radius; j <= radius; ++j) {
                        for (int i = -radius; i <= radius; ++i) {
                            low = std::min(low, clampedAt(in, size, x + i, y + j));
                            high = std::max(high, clampedAt(in, size, x + i, y + j));
                        }
                    }
                    const std::size_t p = static_cast<std::size_t>(y) * size.width + x;
                    ASSERT_EQ(range.low[p], low) << x << ',' << y << " radius " << radius;
                    ASSERT_EQ(range.high[p], high) << x << ',' << y << " radius " << radius;
                }
            }
        }
    }
}

TEST(LocalRange, CanBeReusedForAnotherSize) {
    LocalRange range;
    localRange(randomField({40, 30}, 100), {40, 30}, 2, range);
    const std::vector<float> in(35, 3.5F);
    localRange(in, {7, 5}, 2, range);
    EXPECT_EQ(range.low, in);
    EXPECT_EQ(range.high, in);
}

}  // namespace
}  // namespace mfar
