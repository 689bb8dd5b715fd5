#include "pipeline/reference.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

/// A reference still. `shows`: share of tiles that it showed. `moved`: displacement of all cells
/// since the first frame [px]. `weight`: weight of all cells in the last frame.
struct Known {
    explicit Known(double shows, float moved = 0, float weight = 1) {
        cells.assign(12, {3 + moved, 2, weight, 1});
        weights.weighed.writtenOnHost(Rows<const WeighedCell>{cells.data(), 4, {4, 3}});
        reference.pictures = &pictures;
        reference.lastFlow = &flow;
        reference.lastWeights = &weights;
        reference.first.assign(12, {3, 2, 1, 1});
        reference.shows = shows;
    }

    std::vector<WeighedCell> cells;
    CellWeights weights;
    FlowCells flow;
    StillPictures pictures;
    Reference reference;
};

TEST(Reference, MotionSinceTheStillIsTheMeanDisplacementOfMatchedCells) {
    EXPECT_EQ(Known(1).reference.moved(), 0);
    EXPECT_NEAR(Known(1, -5).reference.moved(), 5, 1e-6);
    Known half(1, 8);
    half.reference.first[0].x = 11;
    half.cells[1].weight = 0;
    EXPECT_NEAR(half.reference.moved(), 80.0 / 11, 1e-5)
        << "one of the eleven matched cells has not moved";
    EXPECT_GT(Known(1, 0, 0).reference.moved(), 1e6) << "no cell is matched any more";
    half.reference.first.clear();
    EXPECT_EQ(half.reference.moved(), 0) << "without a matched frame the motion must be 0";
}

TEST(Reference, ShareOfShownTilesIsSmoothedOverFrames) {
    Reference still;
    still.count(0, 0);
    EXPECT_EQ(still.shows, 1);
    for (int i = 0; i < 100; ++i)
        still.count(40, 10);
    EXPECT_NEAR(still.shows, 0.25, 1e-4);
}

TEST(KeepsOlder, WithoutAnOlderStillNoneIsKept) {
    const Reference none;
    EXPECT_FALSE(keepsOlder(none, Known(0.1).reference));
}

TEST(KeepsOlder, KeepsTheOlderStillIfTheViewHardlyMovedSinceTheNewestStill) {
    const Known older(0.1);
    EXPECT_TRUE(keepsOlder(older.reference, Known(0.9, 1).reference));
    EXPECT_FALSE(keepsOlder(older.reference, Known(0.9, 20).reference));
}

TEST(KeepsOlder, KeepsTheOlderStillIfItShowsMoreThanTheNewest) {
    const Known older(0.6);
    EXPECT_TRUE(keepsOlder(older.reference, Known(0.5, 20).reference));
    EXPECT_FALSE(keepsOlder(older.reference, Known(0.7, 20).reference));
}

}  // namespace
}  // namespace mfar
