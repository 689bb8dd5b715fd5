#include "pipeline/plan/second_tiles.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar {
namespace {

constexpr Size kTiles{5, 4}, kCells{20, 16};

/// A picture of twenty tiles, all shown by the newest still. Tests then mark some as not shown.
class SecondTilesTest : public testing::Test {
protected:
    SecondTilesTest()
        : weighed_(kCells.width * kCells.height, WeighedCell{0, 0, 1, 1}),
          second_(weighed_.size(), WeighedCell{0, 0, 0, 0}),
          trust_(weighed_.size(), TrustCell{0.5F, 1, 1, 0}),
          measured_(kTiles.width * kTiles.height, TileMeasure{.structure = 100}) {}

    static void fill(std::vector<WeighedCell>& field, int tile, float weight) {
        forCells(tile, [&](int i) { field[i].weight = weight; });
    }
    template <class Body>
    static void forCells(int tile, const Body& body) {
        for (int i = 0; i < 16; ++i)
            body((4 * (tile / kTiles.width) + i / 4) * kCells.width + 4 * (tile % kTiles.width) +
                 i % 4);
    }
    static Rows<const WeighedCell> rowsOf(const std::vector<WeighedCell>& field) {
        return {field.data(), kCells.width, kCells};
    }
    [[nodiscard]] SecondTiles::Match newest() const {
        return {rowsOf(weighed_), {trust_.data(), kCells.width, kCells}};
    }
    std::vector<int> chosen(int most = 20) {
        const TileWork& work = tiles_.choose(work_, measured_, newest(), most);
        std::vector<int> out;
        for (std::size_t i = 0; i < work.flags.size(); ++i)
            if (work.flags[i].matched != 0) out.push_back(static_cast<int>(i));
        EXPECT_EQ(work.matched, static_cast<int>(out.size()));
        return out;
    }
    void judge() { tiles_.judge(newest(), rowsOf(second_)); }

    std::vector<WeighedCell> weighed_, second_;
    std::vector<TrustCell> trust_;
    std::vector<TileMeasure> measured_;
    TileWork work_ = TileWork::everything(kTiles);
    SecondTiles tiles_{kTiles};
};

using Tiles = std::vector<int>;

TEST_F(SecondTilesTest, ChoosesNoTileIfTheNewestStillShowsAll) {
    EXPECT_EQ(chosen(), Tiles{});
    EXPECT_EQ(tiles_.matched(), 20);
    EXPECT_EQ(tiles_.shownByNewest(), 20);
}

TEST_F(SecondTilesTest, ChoosesTilesThatTheNewestStillDoesNotShow) {
    fill(weighed_, 3, 0);
    fill(weighed_, 17, 0.5F);
    fill(weighed_, 18, 0.95F);
    EXPECT_EQ(chosen(), (Tiles{3, 17}));
    EXPECT_EQ(tiles_.shownByNewest(), 18);
}

TEST_F(SecondTilesTest, TilesWithoutStructureAreNotChosen) {
    fill(weighed_, 3, 0);
    forCells(3, [&](int i) { trust_[i].signal = 0; });
    EXPECT_EQ(chosen(), Tiles{});
}

TEST_F(SecondTilesTest, IfTooManyTilesQualifyThoseWithMostUnshownStructureAreChosen) {
    for (const int tile : {2, 3, 9, 11})
        fill(weighed_, tile, 0);
    measured_[9].structure = 300;
    fill(weighed_, 3, 0.3F);
    measured_[2].structure = 90;
    EXPECT_EQ(chosen(2), (Tiles{9, 11}));
    EXPECT_EQ(chosen(3), (Tiles{2, 9, 11}));
    EXPECT_EQ(chosen(0), Tiles{});
}

TEST_F(SecondTilesTest, TilesThatAreNotDrawnOrNotMatchedAreNotChosen) {
    for (const int tile : {2, 3, 9})
        fill(weighed_, tile, 0);
    work_.draw = TileWork::Draw::Tiles;
    work_.flags[2].changed = 0;
    work_.flags[3].matched = 0;
    EXPECT_EQ(chosen(), Tiles{9});
    EXPECT_EQ(tiles_.matched(), 18);
    work_.draw = TileWork::Draw::Whole;
    EXPECT_EQ(chosen(), (Tiles{2, 9})) << "in a wholly drawn frame, unchanged tiles can be chosen";
}

TEST_F(SecondTilesTest, TilesThatNeitherStillShowsAreNotMatchedForAWhile) {
    for (const int tile : {2, 3})
        fill(weighed_, tile, 0);
    fill(second_, 3, 0.8F);
    EXPECT_EQ(chosen(), (Tiles{2, 3}));
    judge();
    EXPECT_EQ(tiles_.gained(), 1);
    for (int i = 0; i < SecondTiles::kRest; ++i) {
        EXPECT_EQ(chosen(), Tiles{3});
        judge();
    }
    EXPECT_EQ(chosen(), (Tiles{2, 3}));
    judge();
    tiles_.forget();
    EXPECT_EQ(chosen(), (Tiles{2, 3})) << "with another still, all tiles can be chosen again";
}

TEST_F(SecondTilesTest, TilesThatTheSecondStillShowsArePreferred) {
    for (const int tile : {2, 3})
        fill(weighed_, tile, 0);
    fill(second_, 2, 1);
    fill(second_, 3, 1);
    measured_[3].structure = 110;
    EXPECT_EQ(chosen(1), Tiles{3});
    judge();
    measured_[2].structure = 120;
    EXPECT_EQ(chosen(1), Tiles{3});
    measured_[2].structure = 200;
    EXPECT_EQ(chosen(1), Tiles{2});
}

TEST_F(SecondTilesTest, NanWeightsChooseNoTile) {
    fill(weighed_, 3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(chosen(), Tiles{});
    fill(weighed_, 4, 0);
    fill(second_, 4, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(chosen(), Tiles{4});
    judge();
    EXPECT_EQ(tiles_.gained(), 0);
}

}  // namespace
}  // namespace mfar
