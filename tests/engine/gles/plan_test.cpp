#include "pipeline/gles/tile_buffer.h"
#include "tests/engine/gl_test.h"
#include "tests/oracle/plan.h"

#include <array>
#include <random>

namespace mfar {
namespace {

using Plan = GlTest;

constexpr Size kSize{100, 60};  // 7x4 tiles, the last ones cut off
// Limits of TileChange::mean and TileChange::absolute [grey levels]; see twin::ChangeBounds. They
// belong to noise of 0.29 grey levels, which is assumed until the noise is measured.
constexpr double kMeanThreshold = 1.58, kAbsoluteThreshold = 2.66;

struct TileState {
    std::uint32_t changed, matched;
    double noise, structure;
    std::array<double, 3> energy;
};

std::vector<TileState> tilesOf(const WorkPlan& plan) {
    const auto count = static_cast<std::size_t>(plan.tileCount().width) * plan.tileCount().height;
    const std::vector<TileWork::Tile>& flags = plan.work().flags;
    std::vector<TileState> out;
    for (std::size_t i = 0; i < count; ++i) {
        const TileMeasure& m = plan.measured()[i];
        out.push_back({flags[i].changed,
                       flags[i].matched,
                       m.noise,
                       m.structure,
                       {m.pixels, m.means, m.bends}});
    }
    return out;
}

TestPicture changedIn(TestPicture base, int tiles, int by) {
    TestPicture out = base;
    for (int t = 0; t < tiles; ++t)
        for (int i = 0; i < 64; ++i) {
            // Columns and rows 4 to 11 of the tile change. The last column of tiles is only four
            // pixels wide: there, all columns of pixels change.
            const int x = t % 7 == 6 ? 96 + i % 4 : 16 * (t % 7) + 4 + i % 8;
            std::uint8_t* pixel = out.at(x, 16 * (t / 7) + 4 + i / 8);
            pixel[1] = static_cast<std::uint8_t>(base.at(x, 16 * (t / 7) + 4 + i / 8)[1] ^ by);
        }
    return out;
}

TEST_F(Plan, ChangedTilesAndMeasuredNoiseMatchTheOracle) {
    const TestPicture drawn = Waves(1, 6, 60, 30).shoot(kSize, {});
    TestPicture now = drawn;
    std::mt19937 random(7);
    for (int tile = 0; tile < 28; ++tile)
        for (int i = 0; i < 256; ++i) {
            const int x = 16 * (tile % 7) + i % 16, y = 16 * (tile / 7) + i / 16;
            if (x < kSize.width && y < kSize.height)
                now.at(x, y)[tile % 3] += static_cast<std::uint8_t>(random() % (1 + tile / 3));
        }
    WorkPlan plan(kSize);
    plan.update(planesOf(now), planesOf(drawn), false);
    const auto tiles = tilesOf(plan);
    std::vector<twin::TileChange> twins;
    const twin::Grey grey = twin::luma(now.view());
    int changed = 0, decided = 0;
    for (int i = 0; i < 28; ++i) {
        const twin::TileChange& t =
            twins.emplace_back(twin::tileChange(now, drawn, grey, i % 7, i / 7));
        EXPECT_NEAR(tiles[i].noise, t.noise, 0.005) << "tile " << i;
        EXPECT_NEAR(tiles[i].structure, t.structure, 1e-3 * (1 + t.structure)) << "tile " << i;
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

TEST_F(Plan, TilesUnderVirtualObjectsAreRedrawnIfAnyOtherTileChanges) {
    const TestPicture base = Waves(1, 6, 60, 30).shoot(kSize, {});
    const TestPicture oneTile = changedIn(base, 1, 64);
    WorkPlan plan(kSize);
    plan.drawnOver({2, 1, 4, 9}, WorkPlan::Redraw::WithOthers);
    plan.update(planesOf(base), planesOf(base), false);
    EXPECT_EQ(plan.work().changed, 0);
    EXPECT_FALSE(plan.redraws());
    plan.drawnOver({2, 1, 4, 9}, WorkPlan::Redraw::WithOthers);
    plan.update(planesOf(oneTile), planesOf(base), false);
    EXPECT_EQ(plan.work().changed, 1 + 2 * 3);
    const auto tiles = tilesOf(plan);
    for (int i = 0; i < 28; ++i) {
        const bool over = i % 7 >= 2 && i % 7 < 4 && i / 7 >= 1;
        EXPECT_EQ(tiles[i].changed, i == 0 || over ? 1U : 0U) << "tile " << i;
    }
    EXPECT_TRUE(plan.redraws());
    plan.drawnOver({2, 1, 4, 9}, WorkPlan::Redraw::Always);
    plan.update(planesOf(base), planesOf(base), false);
    EXPECT_EQ(plan.work().changed, 6);
    EXPECT_TRUE(plan.redraws());
    plan.update(planesOf(base), planesOf(base), false);
    EXPECT_EQ(plan.work().changed, 0) << "tiles must be redrawn only once";
    plan.update(planesOf(base), planesOf(base), true);
    EXPECT_EQ(plan.work().changed, 28) << "a tile must not be counted twice";
}

TEST_F(Plan, AllTilesUnderVirtualObjectsAreRedrawnIfOneOfThemChanges) {
    const TestPicture base = Waves(1, 6, 60, 30).shoot(kSize, {});
    const TestPicture oneTile = changedIn(base, 1, 64);
    WorkPlan plan(kSize);
    plan.drawnOver({2, 0, 4, 2}, WorkPlan::Redraw::WithThem);
    plan.update(planesOf(oneTile), planesOf(base), false);
    EXPECT_EQ(plan.work().changed, 1);
    EXPECT_FALSE(plan.redraws());
    plan.drawnOver({1, 0, 4, 2}, WorkPlan::Redraw::WithThem);
    plan.update(planesOf(oneTile), planesOf(base), false);
    EXPECT_EQ(plan.work().changed, 1 + 3 * 2)
        << "tiles next to the changed one must be redrawn together with it";
    EXPECT_TRUE(plan.redraws());
    plan.update(planesOf(base), planesOf(base), true);
    EXPECT_TRUE(plan.redraws());
}

TEST_F(Plan, GaussianNoiseIsMeasured) {
    for (const double sigma : {1.0, 2.0, 3.0}) {
        WorkPlan plan({320, 240});
        for (unsigned i = 0; i < 24; ++i) {
            TestPicture noisy = Waves(5, 40, 300, 30).shoot({320, 240}, {});
            addNoise(noisy, sigma, i);
            plan.update(planesOf(noisy), planesOf(noisy), false);
        }
        EXPECT_NEAR(plan.noise(), sigma, 0.15 * sigma);
    }
}

// Enlarging a tile reads two pixels beyond its border.
TEST_F(Plan, AChangeAtTheBorderOfATileMarksTheNeighbouringTile) {
    const TestPicture base = Waves(1, 6, 60, 30).shoot(kSize, {});
    struct Case {
        int x, y;
        std::vector<int> tiles;
    };
    for (const Case& c :
         {Case{16 + 6, 16 + 6, {8}}, Case{16, 16 + 6, {7, 8}}, Case{16 + 12, 16 + 6, {8, 9}},
          Case{16 + 6, 16, {1, 8}}, Case{16 + 6, 16 + 12, {8, 15}}, Case{16, 16, {0, 1, 7, 8}},
          Case{0, 0, {0}}}) {
        TestPicture now = base;
        for (int i = 0; i < 16; ++i)
            now.at(c.x + i % 4, c.y + i / 4)[1] ^= 64;
        WorkPlan plan(kSize);
        plan.update(planesOf(now), planesOf(base), false);
        std::vector<int> found;
        const auto tiles = tilesOf(plan);
        for (int i = 0; i < 28; ++i)
            if (tiles[i].changed != 0) found.push_back(i);
        EXPECT_EQ(found, c.tiles) << c.x << ',' << c.y;
    }
}

TEST_F(Plan, UnchangedFramesDrawNothing) {
    const TestPicture p = randomPicture(kSize, 1);
    WorkPlan plan(kSize);
    plan.update(planesOf(p), planesOf(p), false);
    for (const TileState& t : tilesOf(plan))
        EXPECT_EQ(t.changed, 0U);
    EXPECT_EQ(plan.work().changed, 0);
    EXPECT_FALSE(plan.work().drawsWhole());
}

TEST_F(Plan, AForcedFrameMarksEveryTileChanged) {
    const TestPicture p = randomPicture(kSize, 1);
    WorkPlan plan(kSize);
    plan.update(planesOf(p), planesOf(p), true);
    for (const TileState& t : tilesOf(plan))
        EXPECT_EQ(t.changed, 1U);
    EXPECT_EQ(plan.work().changed, 28);
    EXPECT_TRUE(plan.work().drawsWhole());
    EXPECT_EQ(plan.work().matched, 28);
}

TEST_F(Plan, TheGpuBufferContainsTheFlagsOfEveryTile) {
    TileWork work = TileWork::everything({3, 2});
    work.flags[4] = {1, 0};
    work.flags[5] = {0, 1};
    work.changed = 5;
    work.draw = TileWork::Draw::Tiles;
    TileBuffer buffer({48, 32});
    EXPECT_EQ(buffer.buffer().read<std::uint32_t>(2), (std::vector<std::uint32_t>{1, 6}));
    buffer.set(work);
    EXPECT_EQ(buffer.buffer().read<std::uint32_t>(14),
              (std::vector<std::uint32_t>{0, 5, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 1}));
}

TEST_F(Plan, ManyChangedTilesAreDrawnAsAWholeFrame) {
    const TestPicture base = Waves(2, 20, 100, 20).shoot(kSize, {});
    const int last = 12;
    for (const int tiles : {1, last, last + 1, 28}) {
        WorkPlan plan(kSize);
        plan.update(planesOf(changedIn(base, tiles, 64)), planesOf(base), false);
        const std::uint32_t whole = tiles > last ? 1 : 0;
        EXPECT_EQ(plan.work().changed, tiles);
        EXPECT_EQ(plan.work().drawsWhole(), whole == 1);
        TileBuffer buffer(kSize);
        buffer.set(plan.work());
        EXPECT_EQ(buffer.buffer().read<std::uint32_t>(2),
                  (std::vector<std::uint32_t>{whole, static_cast<std::uint32_t>(tiles)}));
    }
}

/// A noisy brightness ramp with columns of dots, which are four tiles apart. The dots of column i
/// are brighter than the ramp by contrasts[i] [grey levels].
TestPicture dotted(Size size, const std::vector<int>& contrasts) {
    TestPicture out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c)
                out.at(x, y)[c] = static_cast<std::uint8_t>(60 + x / 4);
    addNoise(out, 1.5, 4);
    for (std::size_t i = 0; i < contrasts.size(); ++i)
        for (int y = 4; y < size.height; y += 8)
            for (int k = 0; k < 16; ++k) {
                const int x = static_cast<int>(64 * i) + 24 + k % 4;
                if (y + k / 4 < size.height)
                    for (int c = 0; c < 3; ++c)
                        out.at(x, y + k / 4)[c] += static_cast<std::uint8_t>(contrasts[i]);
            }
    return out;
}

/// Returns the columns of tiles in which all tiles are matched; {-1} if a column has matched and
/// unmatched tiles.
std::vector<int> matchedColumns(const WorkPlan& plan) {
    const auto tiles = tilesOf(plan);
    const Size count = plan.tileCount();
    std::vector<int> out;
    for (int x = 0; x < count.width; ++x) {
        int matched = 0;
        for (int y = 0; y < count.height; ++y)
            matched += static_cast<int>(tiles[y * count.width + x].matched);
        if (matched == count.height)
            out.push_back(x);
        else if (matched > 0)
            return {-1};
    }
    return out;
}

TEST_F(Plan, TilesWithStructureAndTheirNeighboursAreMatched) {
    const Size size{256, 96};
    const TestPicture picture = dotted(size, {20, 60, 0, 40});
    WorkPlan plan(size);
    const auto update = [&] {
        for (int i = 0; i < 20; ++i)  // after these frames the noise is known
            plan.update(planesOf(picture), planesOf(picture), true);
        return matchedColumns(plan);
    };
    EXPECT_EQ(update().size(), 16U) << "at first, all columns must be matched";
    plan.matchStructured(1);
    EXPECT_EQ(update(), (std::vector<int>{0, 1, 2, 4, 5, 6, 12, 13, 14}));
    EXPECT_EQ(plan.work().matched, 9 * 6);
    plan.matchStructured(6.0 / 16);
    EXPECT_EQ(update(), (std::vector<int>{4, 5, 6, 12, 13, 14}))
        << "the columns with the most structure must be matched";
    plan.matchStructured(0.05);
    EXPECT_EQ(plan.work().matched, 6 * 6) << "the new share takes effect only with the next update";
    (void)update();
    const auto tiles = tilesOf(plan);
    std::vector<int> matched;
    for (int i = 0; i < 96; ++i)
        if (tiles[static_cast<std::size_t>(i)].matched != 0) matched.push_back(i);
    EXPECT_EQ(matched, (std::vector<int>{22, 37, 38, 54, 70}))
        << "of the columns 4 to 6, the five tiles nearest to the centre must be matched";
    plan.matchEverything();
    EXPECT_EQ(update().size(), 16U);
}

TEST_F(Plan, NoiseDoesNotSwitchTheDetailOfTilesOnAndOff) {
    const Size size{512, 256};
    TestPicture quiet(size, PixelFormat::Rgba8, 90);
    std::mt19937 random(5);
    for (int tile = 0; tile < 512; ++tile) {
        const int contrast = std::uniform_int_distribution(4, 24)(random);
        for (int k = 0; k < 16; ++k)
            for (int c = 0; c < 3; ++c)
                quiet.at(16 * (tile % 32) + 6 + k % 4, 16 * (tile / 32) + 6 + k / 4)[c] +=
                    static_cast<std::uint8_t>(contrast);
    }
    WorkPlan plan(size);
    plan.matchStructured(0.5);
    std::vector<TileState> last;
    int turns = 0;
    for (unsigned frame = 0; frame < 40; ++frame) {
        TestPicture now = quiet;
        addNoise(now, 1.5, frame);
        plan.update(planesOf(now), planesOf(now), true);
        const auto tiles = tilesOf(plan);
        for (std::size_t i = 0; frame > 20 && i < tiles.size(); ++i)
            turns += tiles[i].matched != last[i].matched ? 1 : 0;
        last = tiles;
    }
    EXPECT_GT(plan.work().matched, 512 / 5);
    EXPECT_LE(plan.work().matched, 512 / 2);
    EXPECT_LT(turns, 19 * 512 / 100) << "at most one tile in a hundred may change in a frame";
}

TEST_F(Plan, ChangedTilesWithoutStructureAreNotMatched) {
    const Size size{256, 96};
    const TestPicture drawn = dotted(size, {60});
    WorkPlan plan(size);
    plan.matchStructured(1);
    for (const bool inStructure : {false, true}) {
        for (int i = 0; i < 20; ++i)
            plan.update(planesOf(drawn), planesOf(drawn), false);
        TestPicture now = drawn;
        for (int i = 0; i < 256; ++i)
            now.at((inStructure ? 16 : 192) + i % 16, 32 + i / 16)[1] += 9;
        plan.update(planesOf(now), planesOf(drawn), false);
        EXPECT_EQ(plan.work().changed, 9)
            << "the changed tile and its eight neighbours must be redrawn";
        EXPECT_EQ(plan.work().matched, inStructure ? 9 : 0);
    }
}

void planWhole(WorkPlan& plan, const TestPicture& picture) {
    for (int i = 0; i < 20; ++i)
        plan.update(planesOf(picture), planesOf(picture), true);
}

// The structured tiles are far apart. A rectangle around them would mostly contain tiles without
// structure.
TEST_F(Plan, AWholeFrameWithLittleStructureIsEnlarged) {
    const Size size{512, 96};
    for (const bool structured : {false, true}) {
        WorkPlan plan(size);
        plan.matchStructured(1);
        planWhole(plan,
                  structured ? randomPicture(size, 1) : dotted(size, {60, 0, 0, 0, 0, 0, 0, 60}));
        EXPECT_EQ(plan.work().draw == TileWork::Draw::Whole, structured);
        EXPECT_EQ(plan.work().draw == TileWork::Draw::WholeEnlarged, !structured);
        TileBuffer buffer(size);
        buffer.set(plan.work());
        EXPECT_EQ(buffer.buffer().read<std::uint32_t>(1)[0], structured ? 1U : 2U);
    }
}

TEST_F(Plan, DetailIsDrawnInARectangleAroundTheStructure) {
    const Size size{256, 96};
    WorkPlan plan(size);
    plan.matchStructured(1);
    planWhole(plan, dotted(size, {0, 60}));
    EXPECT_TRUE(plan.work().draw == TileWork::Draw::Whole);
    EXPECT_EQ(plan.work().detailTiles, (PixelRect{4, 0, 7, 6}));
    plan.matchEverything();
    planWhole(plan, randomPicture(size, 1));
    EXPECT_EQ(plan.work().detailTiles, (PixelRect{0, 0, 16, 6}));
    plan.matchStructured(1);
    plan.drawWholeFrom(0);
    planWhole(plan, dotted(size, {0, 60}));
    EXPECT_EQ(plan.work().detailTiles, (PixelRect{0, 0, 16, 6}));
}

}  // namespace
}  // namespace mfar
