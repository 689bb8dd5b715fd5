#include "tests/engine/simd/detail_oracle.h"
#include "tests/engine/simd/every_target.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace mfar::simd {
namespace {

constexpr Size kVideo{160, 120}, kStill{400, 300}, kOutput{576, 432};
constexpr int kFrom = 20, kTo = 32;

/// A frame with two stills. The second still is inverted. Its weight exceeds that of the first
/// still by `more` in some columns of cells; elsewhere, its weight is 0.
struct TwoStills {
    explicit TwoStills(float more, double changedShare = 1)
        : frame(kVideo, kStill, changedShare), other(kVideo, kStill, changedShare) {
        for (std::uint8_t& byte : other.stillPixels)
            byte = static_cast<std::uint8_t>(255 - byte);
        for (std::size_t i = 0; i < other.lookUps.size(); ++i) {
            const auto column = static_cast<int>(i) % frame.cells.width;
            frame.lookUps[i].weight = frame.weighed[i].weight = 0.3F;
            const float weight = column >= kFrom && column < kTo ? 0.3F + more : 0;
            other.lookUps[i].weight = other.weighed[i].weight = weight;
            other.trust[i].unexplained = 0;
        }
    }

    DetailCase frame, other;
};

struct DrawnWithBoth {
    explicit DrawnWithBoth(const TwoStills& stills, SuperResMode mode = SuperResMode::Detail)
        : workers(std::make_shared<Workers>(2)), first(stills.frame.rig, kOutput, workers),
          second(stills.frame.rig, kOutput, workers), step(first.rig(), kOutput, workers),
          out(kOutput) {
        first.set(stills.frame.stillView());
        second.set(stills.other.stillView());
        for (int y = 0; y < kOutput.height; ++y)
            std::fill_n(out[y], kOutput.width, kBefore);
        DetailInput in = stills.frame.input(&first);
        const DetailInput of = stills.other.input(&second);
        in.second = {of.still, of.weighed, of.lookUps, of.trust};
        summary = step.draw(in, {mode, true, true, true, &FilterBank::prior()}, out.rows());
    }

    std::shared_ptr<Workers> workers;
    StillPreparation first, second;
    DetailStep step;
    AlignedRows<std::uint32_t> out;
    TileSummary summary;
};

DetailOptions withFilters(SuperResMode mode = SuperResMode::Detail) {
    return {mode, true, true, true, &FilterBank::prior()};
}

int green(const AlignedRows<std::uint32_t>& rows, int x, int y) {
    return static_cast<int>(rows.rows()[y][x] >> 8 & 255);
}

void expectAlike(const AlignedRows<std::uint32_t>& a, const AlignedRows<std::uint32_t>& b) {
    for (int y = 0; y < kOutput.height; ++y)
        for (int x = 0; x < kOutput.width; ++x)
            ASSERT_EQ(a.rows()[y][x], b.rows()[y][x]) << x << " " << y;
}

TEST(DetailStepSecond, ASecondStillIsShownOnlyWhereItsWeightIsClearlyHigher) {
    for (const float more : {-0.3F, 0.0F, 0.9F * params::kSecondFrom}) {
        const TwoStills stills(more);
        const DrawnWithBoth both(stills);
        const Drawn one(stills.frame, kOutput, withFilters());
        EXPECT_EQ(both.summary.second, 0);
        EXPECT_EQ(both.summary.tiles, one.summary.tiles);
        expectAlike(both.out, one.out);
    }
}

TEST(DetailStepSecond, ASecondStillWithHigherWeightBlendsWithoutASeam) {
    const TwoStills stills(0.6F);
    test::onEveryTarget([&] {
        const DrawnWithBoth both(stills);
        const Drawn first(stills.frame, kOutput, withFilters()),
            second(stills.other, kOutput, withFilters());
        EXPECT_EQ(both.summary.second, 5 * 8)
            << "tile columns 4 to 8 of ten must show the second still";
        int differs = 0;
        for (int y = 0; y < kOutput.height; ++y)
            for (int x = 0; x < kOutput.width; ++x) {
                const double cell = (x + 0.5) * kVideo.width / kOutput.width / 4 - 0.5;
                const int a = green(first.out, x, y), b = green(second.out, x, y),
                          got = green(both.out, x, y);
                ASSERT_GE(got, std::min(a, b) - 1) << x << " " << y;
                ASSERT_LE(got, std::max(a, b) + 1) << x << " " << y;
                if (cell >= kFrom && cell <= kTo - 1) {
                    ASSERT_NEAR(got, b, 1) << x << " " << y;
                    differs += std::abs(a - b) > 8;
                } else if (cell < kFrom - 1 || cell > kTo) {
                    ASSERT_EQ(got, a) << x << " " << y;
                }
            }
        EXPECT_GT(differs, 5000) << "the test needs stills that show different pictures";
    });
}

TEST(DetailStepSecond, ChangedTilesMatchAWholeFrame) {
    const TwoStills part(0.6F, 0.4), whole(0.6F);
    const DrawnWithBoth some(part), all(whole);
    for (int y = 0; y < kOutput.height; ++y)
        for (int x = 0; x < kOutput.width; ++x) {
            const bool changed = part.frame.work
                                     .at(tileAt(x, kVideo.width, kOutput.width),
                                         tileAt(y, kVideo.height, kOutput.height))
                                     .changed != 0;
            ASSERT_EQ(some.out.rows()[y][x], changed ? all.out.rows()[y][x] : kBefore)
                << x << " " << y;
        }
}

TEST(DetailStepSecond, ATileThatMatchesTheSecondStillCountsAsMatched) {
    TwoStills stills(0.6F);
    for (TrustCell& cell : stills.frame.trust)
        cell.unexplained = 1;
    const DrawnWithBoth both(stills);
    EXPECT_EQ(both.summary.unexplained, 10 * 8 - 3 * 8)
        << "three columns of tiles must match the second still";
    for (TrustCell& cell : stills.other.trust)
        cell.unexplained = 1;
    EXPECT_EQ(DrawnWithBoth(stills).summary.unexplained, 10 * 8);
}

TEST(DetailStepSecond, OnlyModeDetailShowsTheSecondStill) {
    const TwoStills stills(0.6F);
    for (const SuperResMode mode : {SuperResMode::Off, SuperResMode::Blend}) {
        const DrawnWithBoth both(stills, mode);
        EXPECT_EQ(both.summary.second, 0);
        expectAlike(both.out, Drawn(stills.frame, kOutput, withFilters(mode)).out);
    }
}

}  // namespace
}  // namespace mfar::simd
