#include "pipeline/render/share_table.h"

#include <gtest/gtest.h>

#include <numeric>

namespace mfar {
namespace {

/// Passes `count` evenly spaced numbers from 0 to 1 to draw(). Returns the share of each index in
/// the results.
std::vector<double> drawnShares(const std::vector<double>& weights, int count) {
    const ShareTable table(weights);
    std::vector<double> out(weights.size(), 0);
    for (int i = 0; i < count; ++i)
        out.at(table.draw((i + 0.5) / count).index) += 1.0 / count;
    return out;
}

TEST(ShareTable, IndicesAreDrawnInProportionToTheirWeights) {
    for (const std::vector<double>& weights :
         {std::vector<double>{3}, std::vector<double>{1, 2, 3, 4}, std::vector<double>{5, 5, 5},
          std::vector<double>{0, 1e-6, 100, 0, 7, 0.25}, std::vector<double>{1e300, 1e299}}) {
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        const std::vector<double> shares = drawnShares(weights, 60000);
        for (std::size_t i = 0; i < weights.size(); ++i)
            EXPECT_NEAR(shares[i], weights[i] / sum, 2e-4) << i << " of " << weights.size();
    }
}

TEST(ShareTable, IndicesOfWeightZeroAreNeverDrawn) {
    // Thirds are not exact in binary, so rounding errors remain when the table is built.
    std::vector<double> weights;
    for (int i = 0; i < 3000; ++i)
        weights.push_back(i % 3 == 0 ? 0 : 1.0 / 3);
    const std::vector<double> shares = drawnShares(weights, 300000);
    for (std::size_t i = 0; i < weights.size(); i += 3)
        EXPECT_EQ(shares[i], 0) << i;
}

TEST(ShareTable, TheUnusedPartOfTheRandomNumberIsUniformForEachIndex) {
    const ShareTable table(std::vector<double>{1, 5, 2, 8});
    std::array<double, 4> sums{}, squares{}, counts{};
    constexpr int kCount = 100000;
    for (int i = 0; i < kCount; ++i) {
        const auto [index, rest] = table.draw((i + 0.5) / kCount);
        EXPECT_TRUE(rest >= 0 && rest < 1);
        sums.at(index) += rest;
        squares.at(index) += static_cast<double>(rest) * rest;
        ++counts.at(index);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(sums[i] / counts[i], 1.0 / 2, 1e-3) << i;
        EXPECT_NEAR(squares[i] / counts[i], 1.0 / 3, 1e-3) << i;
    }
}

TEST(ShareTable, LargestRandomNumberDrawsAValidIndex) {
    const ShareTable table(std::vector<double>{1, 2, 3});
    for (const double u : {0.0, 1 - 0x1p-24, 1 - 0x1p-48}) {
        EXPECT_LT(table.draw(u).index, 3U);
        EXPECT_LT(table.draw(u).rest, 1);
    }
}

TEST(ShareTable, IsEmptyWithoutWeight) {
    EXPECT_TRUE(ShareTable().empty());
    EXPECT_TRUE(ShareTable(std::vector<double>{}).empty());
    EXPECT_TRUE(ShareTable(std::vector<double>{0, 0}).empty());
    EXPECT_FALSE(ShareTable(std::vector<double>{0, 1}).empty());
}

}  // namespace
}  // namespace mfar
