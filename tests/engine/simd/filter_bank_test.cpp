#include "pipeline/enlarge/filter_bank.h"

#include <gtest/gtest.h>

#include <set>

namespace mfar {
namespace {

using namespace enlarge;

std::vector<FilterBank::Filter> numberedFilters() {
    std::vector<FilterBank::Filter> out(kUnique);
    for (int i = 0; i < kUnique; ++i)
        for (int k = 0; k < kFilterSize; ++k)
            out[i][k] = static_cast<std::int16_t>((i * 7 + k * 3) % 997 - 498);
    return out;
}

std::string faultOf(std::span<const std::uint8_t> bytes) {
    try {
        (void)readFilters(bytes, "some.filters");
    } catch (const FilterBankError& e) {
        return e.what();
    }
    return "";
}

TEST(FilterBank, EachTapIsADifferentNeighbour) {
    std::set<std::pair<int, int>> seen;
    for (int i = 0; i < kTaps; ++i) {
        const Offset at = kTapAt[i];
        EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 2);
        EXPECT_EQ(tapAt(at), i);
        seen.insert({at.x, at.y});
    }
    EXPECT_EQ(seen.size(), std::size_t{kTaps});
    EXPECT_EQ(tapAt({0, 0}), -1);
}

TEST(FilterBank, MirroringMapsAllGradientBinsOntoAQuarterOfThem) {
    for (const int bins : {8, 16})
        for (int bin = 0; bin < bins; ++bin) {
            const Symmetry same = Symmetry::of(bin, bins);
            EXPECT_LT(same.unique, bins / 4) << bin;
            const double angle = ((bin + 0.5) / bins - 0.5) * 3.14159265358979;
            // The direction in the centre of the bin. It is mirrored like the pixels of the bin.
            double x = std::cos(angle), y = std::sin(angle);
            if (same.mirrors) y = -y;
            if (same.transposes) std::swap(x, y);
            double mapped = std::atan2(y, x);
            if (mapped < -1e-9) mapped += 3.14159265358979;
            EXPECT_NEAR(mapped, (same.unique + 0.5) / bins * 3.14159265358979, 1e-6) << bin;
        }
}

TEST(FilterBank, StoredFiltersAreReadAgain) {
    const auto filters = numberedFilters();
    EXPECT_EQ(readFilters(storedFilters(filters), "x"), filters);
}

TEST(FilterBank, DamagedFiltersAreRefusedAndTheMessageSaysWhy) {
    const auto whole = storedFilters(numberedFilters());
    EXPECT_EQ(faultOf(whole), "");
    auto damaged = whole;
    damaged[0] ^= 1;
    EXPECT_EQ(faultOf(damaged), "some.filters: is not a filter file of mfar");
    damaged = whole;
    damaged[8] = 9;
    EXPECT_EQ(faultOf(damaged), "some.filters: has format version 9; expected 1");
    damaged = whole;
    damaged[12] ^= 1;
    EXPECT_NE(faultOf(damaged).find("other filter classes"), std::string::npos);
    EXPECT_NE(faultOf(std::span(whole).first(whole.size() - 1)).find("bytes; expected"),
              std::string::npos);
    EXPECT_NE(faultOf(std::span(whole).first(10)).find("not a filter file"), std::string::npos);
    for (const std::size_t at : {std::size_t{28}, whole.size() / 2, whole.size() - 1}) {
        damaged = whole;
        damaged[at] ^= 64;
        EXPECT_EQ(faultOf(damaged), "some.filters: is damaged: the checksum is wrong") << at;
    }
}

TEST(FilterBank, WeightsWhoseSumsWouldOverflowAreRefused) {
    auto filters = numberedFilters();
    filters[3].fill(32767);
    EXPECT_THROW(FilterBank{filters}, FilterBankError);
    EXPECT_THROW(FilterBank(std::span(filters).first(5)), FilterBankError);
}

TEST(FilterBank, ShippedFiltersCoverMostClasses) {
    const Rows<const std::int16_t> gradient = FilterBank::prior().gradient();
    ASSERT_EQ(gradient.size.height, GradientClasses::kCount);
    int learned = 0;
    for (int i = 0; i < GradientClasses::kCount; ++i)
        learned += std::any_of(gradient[i], gradient[i] + kFilterSize,
                               [](std::int16_t weight) { return weight != 0; });
    EXPECT_GT(learned, GradientClasses::kCount / 2);
}

TEST(FilterBank, TheCubicFilterUsesOnlyNeighboursNearTheSubPixel) {
    // The weight of the pixel itself completes the sum to one. The other weights are those of Keys'
    // cubic.
    const std::int16_t* cubic = FilterBank::prior().cubic();
    int far = 0;
    for (int phase = 0; phase < kPhases; ++phase)
        far += std::abs(cubic[filterIndex(tapAt({-2, -2}), phase)]);
    EXPECT_GT(far, 0);
    EXPECT_EQ(cubic[filterIndex(tapAt({2, 2}), 0)], 0)
        << "the upper left sub-pixel must not use this neighbour";
}

}  // namespace
}  // namespace mfar
