#include "tests/engine/simd/detail_oracle.h"

#include <gtest/gtest.h>

namespace mfar::simd {
namespace {

// Tolerance [grey levels]: luma is rounded to 1/8 grey level, and so are the limits between which
// twin::residualAt() clamps the enlarged luma.
constexpr double kLearnedError = 1.3;

TEST(DetailStepLearned, FramesEnlargedByFiltersMatchTheOracleWithAndWithoutAStill) {
    for (const auto& [video, stillSize, output] : kSizes)
        for (const bool usesStill : {true, false}) {
            if (output.width > 1000) continue;  // large outputs take too long
            const DetailCase frame(video, stillSize);
            const DetailOptions options{SuperResMode::Detail, true, false, true, &evenBank()};
            const Drawn drawn(frame, output, options, usesStill);
            Wanted wanted(frame, output, options, usesStill);
            const Grey still = lumaPlane(drawn.still);
            double most = 0;
            const Drawn without(frame, output, {SuperResMode::Detail, true, false, true}, false);
            for (int y = 0; y < output.height; ++y)
                for (int x = 0; x < output.width; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const double value =
                            usesStill ? wanted.withStill(x, y, c, still) : wanted.enlarged(x, y, c);
                        ASSERT_NEAR(drawn.channel(x, y, c), value, kLearnedError)
                            << output.width << ": " << x << " " << y << " " << c;
                        most = std::max(most, std::abs(value - without.channel(x, y, c)));
                    }
            EXPECT_GT(most, 4) << "the test needs filters that change the picture";
        }
}

TEST(DetailStepLearned, FramesWithGuidanceMatchTheOracle) {
    for (const auto& [video, stillSize, output] : kSizes) {
        if (output.width > 1000) continue;
        const DetailCase frame(video, stillSize);
        const DetailOptions options{SuperResMode::Detail, true, false, true, &guidedBank()};
        const Drawn drawn(frame, output, options),
            without(frame, output, {SuperResMode::Detail, true, false, true, &evenBank()});
        Wanted wanted(frame, output, options, true);
        const Grey still = lumaPlane(drawn.still);
        double most = 0;
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x) {
                const double value = wanted.withStill(x, y, 1, still);
                ASSERT_NEAR(drawn.channel(x, y, 1), value, kLearnedError)
                    << output.width << ": " << x << " " << y;
                most = std::max(most, std::abs(value - without.channel(x, y, 1)));
            }
        EXPECT_GT(most, 4) << output.width << ": the test needs guidance that changes the picture";
    }
}

TEST(DetailStepLearned, TilesWithoutStructureAreNotEnlargedByFilters) {
    const Size output{576, 432};
    DetailCase frame({160, 120}, {400, 300});
    for (std::size_t i = 0; i < frame.work.flags.size(); ++i)
        frame.work.flags[i].matched = i % 3 == 0;
    const DetailOptions options{SuperResMode::Detail, true, true, true, &evenBank()};
    const Drawn drawn(frame, output, options, false);
    const Wanted with(frame, output, options, false), without(frame, output, kDetail, false);
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x) {
            const int tile = tileAt(y, 120, 432) * frame.work.tiles.width + tileAt(x, 160, 576);
            ASSERT_NEAR(drawn.channel(x, y, 1), (tile % 3 == 0 ? with : without).enlarged(x, y, 1),
                        kLearnedError)
                << x << " " << y;
        }
}

// The weight is 1 in all cells except one, which lies at the right edge of its tile. Only the tiles
// around this cell need the filters.
TEST(DetailStepLearned, TilesWhoseWeightsAreAllOneMatchTheOracle) {
    const Size output{576, 432};
    DetailCase frame({160, 120}, {400, 300});
    constexpr int kColumn = 15, kRow = 14;
    for (int i = 0; i < frame.cells.width * frame.cells.height; ++i) {
        const bool low = i == kRow * frame.cells.width + kColumn;
        const float weight = low ? 0 : 1;
        frame.weighed[i].weight = frame.lookUps[i].weight = weight;
        frame.trust[i].halfWeight = 0.5F * weight;
    }
    const DetailOptions options{SuperResMode::Detail, true, false, true, &evenBank()};
    const Drawn drawn(frame, output, options);
    Wanted wanted(frame, output, options, true);
    const Grey still = lumaPlane(drawn.still);
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x)
            ASSERT_NEAR(drawn.channel(x, y, 1), wanted.withStill(x, y, 1, still), kLearnedError)
                << x << " " << y;
}

TEST(DetailStepLearned, OnlyModeDetailUsesTheFilters) {
    const Size output{191, 133};
    const DetailCase frame({53, 37}, {200, 140});
    for (const SuperResMode mode : {SuperResMode::Off, SuperResMode::Blend}) {
        const Drawn with(frame, output, {mode, true, true, true, &evenBank()}),
            without(frame, output, {mode, true, true, true});
        for (int y = 0; y < output.height; ++y)
            ASSERT_TRUE(std::equal(with.out[y], with.out[y] + output.width, without.out[y]));
    }
}

}  // namespace
}  // namespace mfar::simd
