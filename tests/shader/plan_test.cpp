#include "tests/shader/gl_test.h"
#include "tests/shader/twins/plan.h"

#include <array>

namespace mfar {
namespace {

using Plan = GlTest;

constexpr Size kSize{100, 60};  // 7x4 tiles, the last ones cut
// Thresholds of a frame without measured noise (0.29 grey levels).
constexpr double kMeanThreshold = 1.58, kAbsoluteThreshold = 2.37;
constexpr std::size_t kDispatches = 48;  // bytes before them in the plan's buffer

struct TileState {
    std::uint32_t changed;
    double noise;
    std::array<double, 3> energy;  // of the difference: pixels, 2x2 means, their twist
};

std::vector<TileState> tilesOf(const WorkPlan& plan) {
    const auto count = static_cast<std::size_t>(plan.tileCount().width) * plan.tileCount().height;
    const auto flags = plan.tiles().read<std::array<std::uint32_t, 2>>(count, 8);
    const auto measured = plan.measured().read<std::array<float, 8>>(count);
    std::vector<TileState> out;
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(
            {flags[i][0], measured[i][1], {measured[i][4], measured[i][5], measured[i][6]}});
    return out;
}

std::array<std::uint32_t, 4> fourAt(const WorkPlan& plan, std::size_t bytes) {
    const auto v = plan.wholeDraw().commands.read<std::uint32_t>(4, bytes);
    return {v[0], v[1], v[2], v[3]};
}

/// `base` with the first `tiles` tiles turned by some grey levels.
Picture changedIn(const Picture& base, int tiles, int by) {
    Picture out = base;
    for (int t = 0; t < tiles; ++t)
        for (int i = 0; i < 256; ++i) {
            const int x = 16 * (t % 7) + i % 16, y = 16 * (t / 7) + i / 16;
            if (x < kSize.width && y < kSize.height)
                out.at(x, y)[1] = static_cast<std::uint8_t>(out.at(x, y)[1] ^ by);
        }
    return out;
}

TEST_F(Plan, FlagsAndNoiseMatchTwin) {
    const Picture drawn = Waves(1, 6, 60, 30).shoot(kSize, {});
    Picture now = drawn;
    std::mt19937 random(7);
    for (int tile = 0; tile < 28; ++tile)  // from hardly any change to much, in one channel
        for (int i = 0; i < 256; ++i) {
            const int x = 16 * (tile % 7) + i % 16, y = 16 * (tile / 7) + i / 16;
            if (x < kSize.width && y < kSize.height)
                now.at(x, y)[tile % 3] += static_cast<std::uint8_t>(random() % (1 + tile / 3));
        }
    WorkPlan plan(kSize);
    plan.update(uploaded(now), uploaded(drawn), false);
    const auto tiles = tilesOf(plan);
    std::vector<twin::TileChange> twins;
    int changed = 0, decided = 0;
    for (int i = 0; i < 28; ++i) {
        const twin::TileChange& t = twins.emplace_back(twin::tileChange(now, drawn, i % 7, i / 7));
        EXPECT_NEAR(tiles[i].noise, t.noise, 0.005) << "tile " << i;
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(tiles[i].energy[k], t.energy[k], 1e-3 * (1 + t.energy[k]))
                << "tile " << i << ", energy " << k;
        changed += static_cast<int>(tiles[i].changed);
    }
    const auto wanted = twin::changedTiles(twins, 7, {kMeanThreshold, kAbsoluteThreshold});
    for (int i = 0; i < 28; ++i) {
        if (!wanted[i]) continue;
        ++decided;
        EXPECT_EQ(tiles[i].changed == 1, *wanted[i]) << "tile " << i;
    }
    EXPECT_GE(decided, 24);
    EXPECT_GE(changed, 5);
    EXPECT_LE(changed, 26);
}

TEST_F(Plan, WhatWasDrawnOverIsDrawnAnewWithAnyOtherTile) {
    const Picture base = Waves(1, 6, 60, 30).shoot(kSize, {});
    const Picture oneTile = changedIn(base, 1, 64);
    WorkPlan plan(kSize);
    const WorkPlan::Dispatch dispatch = plan.add({5, 2, 1});
    plan.drawnOver({2, 1, 4, 9}, WorkPlan::Redraw::WithOthers);
    plan.update(uploaded(base), uploaded(base), false);
    EXPECT_EQ(plan.changedTiles(), 0);
    EXPECT_FALSE(plan.redraws());
    plan.drawnOver({2, 1, 4, 9}, WorkPlan::Redraw::WithOthers);
    EXPECT_EQ(fourAt(plan, kDispatches + 16UL * dispatch.index)[0], 0U);
    plan.update(uploaded(oneTile), uploaded(base), false);
    EXPECT_EQ(plan.changedTiles(), 1 + 2 * 3);
    const auto tiles = tilesOf(plan);
    for (int i = 0; i < 28; ++i) {
        const bool over = i % 7 >= 2 && i % 7 < 4 && i / 7 >= 1;
        EXPECT_EQ(tiles[i].changed, i == 0 || over ? 1U : 0U) << "tile " << i;
    }
    EXPECT_TRUE(plan.redraws());
    plan.drawnOver({2, 1, 4, 9}, WorkPlan::Redraw::Always);
    plan.update(uploaded(base), uploaded(base), false);
    EXPECT_EQ(plan.changedTiles(), 6);
    EXPECT_TRUE(plan.redraws());
    EXPECT_EQ(fourAt(plan, kDispatches + 16UL * dispatch.index)[0], 5U);
    plan.update(uploaded(base), uploaded(base), false);
    EXPECT_EQ(plan.changedTiles(), 0) << "redrawn once";
    plan.update(uploaded(base), uploaded(base), true);
    EXPECT_EQ(plan.changedTiles(), 28) << "none counts twice";
}

TEST_F(Plan, WhatWasDrawnOverIsDrawnAnewWithItsTilesOrTheWhole) {
    const Picture base = Waves(1, 6, 60, 30).shoot(kSize, {});
    const Picture oneTile = changedIn(base, 1, 64);  // the first
    WorkPlan plan(kSize);
    plan.drawnOver({2, 0, 4, 2}, WorkPlan::Redraw::WithThem);
    plan.update(uploaded(oneTile), uploaded(base), false);
    EXPECT_EQ(plan.changedTiles(), 1);
    EXPECT_FALSE(plan.redraws());
    plan.drawnOver({1, 0, 4, 2}, WorkPlan::Redraw::WithThem);
    plan.update(uploaded(oneTile), uploaded(base), false);
    EXPECT_EQ(plan.changedTiles(), 1 + 3 * 2) << "beside them";
    EXPECT_TRUE(plan.redraws());
    plan.update(uploaded(base), uploaded(base), true);
    EXPECT_TRUE(plan.redraws());
}

TEST_F(Plan, NoiseOfAKnownGaussianIsFound) {
    for (const double sigma : {1.0, 2.0, 3.0}) {
        WorkPlan plan({320, 240});
        for (unsigned i = 0; i < 24; ++i) {
            Picture noisy = Waves(5, 40, 300, 30).shoot({320, 240}, {});
            addNoise(noisy, sigma, i);
            plan.update(uploaded(noisy), uploaded(noisy), false);
        }
        EXPECT_NEAR(plan.noise(), sigma, 0.15 * sigma);
    }
}

TEST_F(Plan, NothingChangedShutsEveryDispatch) {
    const Picture p = randomPicture(kSize, 1);
    WorkPlan plan(kSize);
    static_cast<void>(plan.add({3, 2, 1}));
    plan.update(uploaded(p), uploaded(p), false);
    for (const TileState& t : tilesOf(plan))
        EXPECT_EQ(t.changed, 0U);
    EXPECT_EQ(fourAt(plan, 0)[0], 0U);
    EXPECT_EQ(fourAt(plan, 16), (std::array<std::uint32_t, 4>{3, 0, 0, 0}));
    EXPECT_EQ(fourAt(plan, kDispatches)[0], 0U);
}

TEST_F(Plan, AForcedFrameOpensEverything) {
    const Picture p = randomPicture(kSize, 1);
    WorkPlan plan(kSize);
    static_cast<void>(plan.add({3, 2, 1}));
    static_cast<void>(plan.add({5, 4, 2}));
    plan.update(uploaded(p), uploaded(p), true);
    for (const TileState& t : tilesOf(plan))
        EXPECT_EQ(t.changed, 1U);
    EXPECT_EQ(fourAt(plan, 0)[0], 28U);
    EXPECT_EQ(fourAt(plan, 16), (std::array<std::uint32_t, 4>{3, 1, 0, 0}));
    EXPECT_EQ(fourAt(plan, kDispatches), (std::array<std::uint32_t, 4>{3, 2, 1, 0}));
    EXPECT_EQ(fourAt(plan, kDispatches + 16), (std::array<std::uint32_t, 4>{5, 4, 2, 0}));
}

TEST_F(Plan, ManyChangedTilesAreDrawnInOnePiece) {
    const Picture base = Waves(2, 20, 100, 20).shoot(kSize, {});
    const int last = 12;  // 0.45 of 28 tiles are 12.6
    for (const int tiles : {1, last, last + 1, 28}) {
        WorkPlan plan(kSize);
        static_cast<void>(plan.add({1, 1, 1}));
        plan.update(uploaded(changedIn(base, tiles, 64)), uploaded(base), false);
        const std::uint32_t whole = tiles > last ? 1 : 0;
        EXPECT_EQ(fourAt(plan, 0)[0], static_cast<std::uint32_t>(tiles));
        EXPECT_EQ(fourAt(plan, 0)[2], whole);
        EXPECT_EQ(fourAt(plan, 16)[1], whole);
        EXPECT_EQ(plan.tiles().read<std::uint32_t>(2),
                  (std::vector<std::uint32_t>{whole, static_cast<std::uint32_t>(tiles)}));
        EXPECT_EQ(fourAt(plan, kDispatches)[0], 1U);
    }
}

}  // namespace
}  // namespace mfar
