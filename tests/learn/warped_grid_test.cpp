#include "pipeline/enlarge/warped_grid.h"
#include "pipeline/flow/cell_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar::enlarge {
namespace {

constexpr Size kVideo{16, 8};
// Slopes of the still's levels [grey levels per video px]. All levels are from 8 to 216.
constexpr double kAcross = 10, kDown = 6;

double levelAt(double x, double y) {
    return 120 + kAcross * (x - kVideo.width / 2.0) + kDown * (y - kVideo.height / 2.0);
}

/// A still with `scale` pixels per video pixel, whose levels rise evenly from left to right and
/// from top to bottom.
MatchedPictures evenSlope(int scale) {
    MatchedPictures out;
    out.video = kVideo;
    out.still = AlignedRows<std::uint8_t>({scale * kVideo.width, scale * kVideo.height});
    for (int y = 0; y < scale * kVideo.height; ++y)
        for (int x = 0; x < scale * kVideo.width; ++x)
            out.still[y][x] = static_cast<std::uint8_t>(
                std::lround(levelAt((x + 0.5) / scale - 0.5, (y + 0.5) / scale - 0.5)));
    out.scaleX = out.scaleY = scale;
    return out;
}

/// Returns the warped grid of a still if all its look-ups have this offset along both axes [still
/// px].
WarpedGrid warpedBy(const MatchedPictures& pictures, float offset) {
    const Size cells{kVideo.width / kCell, kVideo.height / kCell};
    AlignedRows<LookUpCell> lookUps(cells);
    AlignedRows<std::uint8_t> known(cells);
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            lookUps[y][x] = {offset, offset, 1, 1};
            known[y][x] = 1;
        }
    WarpedGrid out(kVideo);
    out.warp(pictures, lookUps, known, {});
    return out;
}

class WarpedGridOf : public testing::TestWithParam<int> {};

TEST_P(WarpedGridOf, AnEvenSlopeHasTheLevelOfEachSubPixel) {
    const int scale = GetParam();
    const MatchedPictures pictures = evenSlope(scale);
    constexpr float kMoved = 0.75F;  // [video px]
    const WarpedGrid grid = warpedBy(pictures, kMoved * static_cast<float>(scale));
    for (int y = 2; y < kVideo.height - 3; ++y)
        for (int x = 2; x < kVideo.width - 3; ++x) {
            for (int phase = 0; phase < kPhases; ++phase) {
                const int column = phase % kGrid, row = phase / kGrid;
                // The still's levels are rounded, and the cubic's weights may add up the errors.
                ASSERT_NEAR(grid.at(x, y, phase),
                            levelAt(x + kMoved - 0.5 + (column + 0.5) / kGrid,
                                    y + kMoved - 0.5 + (row + 0.5) / kGrid),
                            0.8)
                    << x << ", " << y << ", sub-pixel " << phase;
            }
            ASSERT_NEAR(grid.mean(x, y), levelAt(x + kMoved, y + kMoved), 0.3) << x << ", " << y;
        }
}

// With 4 still pixels per video pixel, each sub-pixel is sampled once; with 8 and 12, four and nine
// times.
INSTANTIATE_TEST_SUITE_P(Stills, WarpedGridOf, testing::Values(4, 8, 12));

TEST(WarpedGrid, StillPixelsBesideThePictureAreThoseAtItsEdge) {
    const MatchedPictures pictures = evenSlope(4);
    const WarpedGrid grid = warpedBy(pictures, -1000);
    EXPECT_EQ(grid.at(5, 5, 0), pictures.still[0][0]);
    EXPECT_EQ(grid.mean(9, 3), pictures.still[0][0]);
}

}  // namespace
}  // namespace mfar::enlarge
