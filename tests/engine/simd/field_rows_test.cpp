#include "pipeline/simd/field_rows.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace mfar::simd {
namespace {

using Row = std::vector<float>;

TEST(FieldRows, MedianIsTheMiddleOfNineValues) {
    for (const std::size_t width : test::kLengths) {
        const Row rows[3] = {test::randomValues<float>(width, -9, 9, 1),
                             test::randomValues<float>(width, -9, 9, 2),
                             test::randomValues<float>(width, -9, 9, 3)};
        Row out(width);
        medianRow(rows[0].data(), rows[1].data(), rows[2].data(), width, 2, out.data());
        for (std::size_t x = 0; x < width; ++x) {
            Row window;
            for (const Row& row : rows)
                window.insert(window.end(),
                              {row[x > 0 ? x - 1 : 0], row[x], row[std::min(x + 1, width - 1)]});
            std::nth_element(window.begin(), window.begin() + 4, window.end());
            ASSERT_EQ(out[x], 2 * window[4]) << x << " of " << width;
        }
    }
}

TEST(FieldRows, RangesContainOnlyValidValues) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const std::size_t width : {1UL, 5UL, 40UL, 255UL, 256UL, 300UL, 700UL}) {
        for (const int radius : {0, 2, 4, kMostRange}) {
            const Row values = test::randomValues<float>(width, -1, 9, 4);
            Row variance = test::randomValues<float>(width, 0.1, 1, 5);
            for (std::size_t x = 0; x < width; x += 3)
                variance[x] = kInfinity;
            for (const bool any : {true, false}) {
                Row low(width), high(width);
                rangeAlongRow(values.data(), any ? nullptr : variance.data(), width, radius,
                              low.data(), high.data());
                for (int x = 0; x < static_cast<int>(width); ++x) {
                    float least = std::numeric_limits<float>::max(), most = -least;
                    for (int u = std::max(x - radius, 0);
                         u <= std::min(x + radius, static_cast<int>(width) - 1); ++u) {
                        if (!any && (values[u] < 0 || variance[u] == kInfinity)) continue;
                        least = std::min(least, values[u]);
                        most = std::max(most, values[u]);
                    }
                    ASSERT_EQ(low[x], least) << x << " of " << width;
                    ASSERT_EQ(high[x], most) << x << " of " << width;
                }
            }
        }
    }
}

TEST(FieldRows, RangeAcrossRowsIsTheLeastAndTheMostOfEachColumn) {
    constexpr std::size_t kWidth = 21, kPitch = 30;
    const Row low = test::randomValues<float>(kPitch * 5, -9, 0, 6);
    const Row high = test::randomValues<float>(kPitch * 5, 0, 9, 7);
    Row outLow(kWidth), outHigh(kWidth);
    rangeAcrossRows(low.data(), high.data(), kPitch, 5, kWidth, outLow.data(), outHigh.data());
    for (std::size_t x = 0; x < kWidth; ++x) {
        float least = 9, most = -9;
        for (std::size_t y = 0; y < 5; ++y) {
            least = std::min(least, low[y * kPitch + x]);
            most = std::max(most, high[y * kPitch + x]);
        }
        EXPECT_EQ(outLow[x], least);
        EXPECT_EQ(outHigh[x], most);
    }
}

TEST(FieldRows, TheMaximumIsFoundAtAnyPosition) {
    EXPECT_EQ(greatestOf(nullptr, 0), 0);
    for (const std::size_t count : test::kLengths)
        for (std::size_t at = 0; at < count; ++at) {
            Row values(count, -1);
            EXPECT_EQ(greatestOf(values.data(), count), 0);
            values[at] = 5;
            EXPECT_EQ(greatestOf(values.data(), count), 5) << at << " of " << count;
        }
}

}  // namespace
}  // namespace mfar::simd
