#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/flow2d.h"
#include "pipeline/simd/luma_pyramids.h"
#include "tests/engine/simd/flow_pictures.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <utility>

namespace mfar::simd {
namespace {

using Eigen::Vector2d;
using Cell = std::array<float, 4>;
constexpr Size kSmall{160, 120};

class Pair {
public:
    Pair(const FlowPicture& a, const FlowPicture& b, const Flow2dOptions& options = {})
        : work(wholeWork(a.size)), flow(a.size, options, twoWorkers()),
          pyramids_(a.size, twoWorkers()) {
        pyramids_.buildFirst(a.rows());
        pyramids_.buildSecond(b.rows());
    }
    void run(bool usePrior = false) { flow.run(luma(), work, usePrior); }
    void refine(const std::vector<Cell>& forward, const std::vector<Cell>& errors) {
        flow.refine(luma(), work, forward, errors, false);
    }
    [[nodiscard]] Flow2d::Luma luma() const {
        return {pyramids_.video(), pyramids_.still(), pyramids_.words()};
    }

    TileWork work;
    Flow2d flow;

private:
    LumaPyramids pyramids_;
};

struct Errors {
    double mean = 0, worst = 0;
    Vector2d bias{0, 0};
};

/// Errors relative to a constant flow [px of the field's level]. Counts only cells that are at
/// least `border` cells inside the picture.
Errors errorsOf(Rows<const FlowCell> field, const Vector2d& truth, int border) {
    Errors e;
    int n = 0;
    for (int y = border; y < field.size.height - border; ++y)
        for (int x = border; x < field.size.width - border; ++x) {
            const Vector2d d = Vector2d(field[y][x].x, field[y][x].y) - truth;
            e.mean += d.norm();
            e.bias += d;
            e.worst = std::max(e.worst, d.norm());
            ++n;
        }
    e.mean /= n;
    e.bias /= n;
    return e;
}

TEST(Flow2d, ShiftsAreFoundInBothDirections) {
    for (const Vector2d& shift :
         std::vector<Vector2d>{Vector2d(0, 0), Vector2d(1, 0), Vector2d(-3, 2), Vector2d(7, -5),
                               Vector2d(0.5, 0.25), Vector2d(-1.3, 0.7), Vector2d(4.6, 3.1)}) {
        Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, shift));
        pair.run();
        const Errors forward = errorsOf(pair.flow.forward(), shift, 4);
        EXPECT_LT(forward.mean, 0.05) << shift.transpose();
        EXPECT_LT(forward.worst, 0.3) << shift.transpose();
        ASSERT_EQ(pair.flow.backwardLevel(), 1);
        const Errors backward = errorsOf(pair.flow.backward(), -0.5 * shift, 3);
        EXPECT_LT(backward.mean, 0.06) << shift.transpose();
    }
}

TEST(Flow2d, LargeMotionIsFound) {
    Pair pair(wavesMoved({640, 480}, {0, 0}), wavesMoved({640, 480}, {60, -12}));
    pair.run();
    EXPECT_LT(errorsOf(pair.flow.forward(), {60, -12}, 18).mean, 0.1);
}

TEST(Flow2d, TinyMotionHasNoBias) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {0.1, -0.1}));
    pair.run();
    EXPECT_LT(errorsOf(pair.flow.forward(), {0.1, -0.1}, 3).bias.norm(), 0.02);
}

TEST(Flow2d, FlowDoesNotDependOnGainAndOffset) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {2.4, -1.7}, 0.7, 40));
    pair.run();
    const Errors e = errorsOf(pair.flow.forward(), {2.4, -1.7}, 4);
    EXPECT_LT(e.mean, 0.05);
    EXPECT_LT(e.worst, 0.3);
}

TEST(Flow2d, FlowBetweenFlatPicturesIsZero) {
    for (const std::uint8_t level : {0, 128, 255}) {
        Pair pair(FlowPicture(kSmall, level), FlowPicture(kSmall, 77));
        for (const bool usePrior : {false, true}) {
            pair.run(usePrior);
            for (int y = 0; y < 30; ++y)
                for (int x = 0; x < 40; ++x) {
                    ASSERT_LE(std::abs(pair.flow.forward()[y][x].x), 1e-3F);
                    ASSERT_LE(std::abs(pair.flow.forward()[y][x].y), 1e-3F);
                }
        }
    }
}

void expectBounded(Rows<const FlowCell> field, float most) {
    for (int y = 0; y < field.size.height; ++y)
        for (int x = 0; x < field.size.width; ++x) {
            const FlowCell& c = field[y][x];
            ASSERT_LE(std::hypot(c.x, c.y), most) << x << ", " << y;
            ASSERT_TRUE(c.cost >= 0 && c.cost <= 2.02F) << c.cost;
            ASSERT_TRUE(c.texture >= 0 && c.texture <= 4.2e6F) << c.texture;
        }
}

TEST(Flow2d, NoiseGivesBoundedFlowAtAnySize) {
    for (const Size size : {kSmall, Size{16, 16}, Size{17, 43}, Size{101, 59}, Size{67, 53}}) {
        FlowPicture chess(size);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                chess.at(x, y) = (x + y) % 2 != 0 ? 255 : 0;
        for (const FlowPicture& b : {noiseOf(size, 2), chess, FlowPicture(size)}) {
            Pair pair(noiseOf(size, 1), b);
            for (const bool usePrior : {false, true}) {
                pair.run(usePrior);
                const auto most = 3.0F * static_cast<float>(std::max(size.width, size.height));
                expectBounded(pair.flow.forward(), most);
                expectBounded(pair.flow.backward(), most);
            }
        }
    }
}

TEST(Flow2d, FlowIsFoundWithAnyNumberOfPyramidLevelsAndPropagationRounds) {
    for (const int levels : {1, 2, 3, 6})
        for (const int rounds : {0, 1, 3}) {
            Flow2dOptions options;
            options.levels = levels;
            options.propagations = options.coarsestPropagations = rounds;
            options.planeFits = std::min(rounds, 2);
            Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {3.4, -2.7}), options);
            pair.run();
            EXPECT_LT(errorsOf(pair.flow.forward(), {3.4, -2.7}, 5).mean, 0.3)
                << levels << " levels, " << rounds << " rounds";
        }
    Flow2dOptions options;
    options.steps = 99;
    EXPECT_THROW(Flow2d(kSmall, options, twoWorkers()), std::invalid_argument);
}

TEST(Flow2d, WithoutMatchedTilesTheFlowIsUnchanged) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {3, 1}));
    pair.work.matched = 0;
    pair.run();
    for (int x = 0; x < 40; ++x)
        EXPECT_EQ(pair.flow.forward()[7][x].x, 0);
}

TileWork someWork(Size video) {
    TileWork work = wholeWork(video);
    work.draw = TileWork::Draw::Tiles;
    work.matched = 0;
    for (std::size_t i = 0; i < work.flags.size(); ++i) {
        TileWork::Tile& tile = work.flags[i];
        tile.matched = i % 7 == 3 || (i > 40 && i < 53) ? 1 : 0;
        work.matched += tile.matched;
    }
    return work;
}

TEST(Flow2d, SkippedTilesDoNotAffectOthers) {
    constexpr Size kVideo{333, 251};
    const FlowPicture a = wavesMoved(kVideo, {0, 0}), b = wavesMoved(kVideo, {5.3, -3.1});
    Pair all(a, b), some(a, b);
    some.work = someWork(kVideo);
    all.run();
    some.run();
    int same = 0, left = 0;
    for (int y = 0; y < some.flow.forward().size.height; ++y)
        for (int x = 0; x < some.flow.forward().size.width; ++x) {
            const FlowCell &wanted = all.flow.forward()[y][x], &got = some.flow.forward()[y][x];
            if (some.work.at(x / 4, y / 4).matched != 0) {
                ++same;
                ASSERT_EQ(wanted.x, got.x) << x << ", " << y;
                ASSERT_EQ(wanted.y, got.y) << x << ", " << y;
                ASSERT_EQ(wanted.cost, got.cost) << x << ", " << y;
                // Where the forward vector ends, both runs must have the same backward vectors.
                const auto at = [&](int cell, float by, int cells) {
                    const auto end = static_cast<int>(std::floor((4.0F * cell + 2 + by) / 8));
                    return std::clamp(end, 0, cells - 1);
                };
                const Rows<const FlowCell> back = some.flow.backward();
                const int bx = at(x, wanted.x, back.size.width);
                const int by = at(y, wanted.y, back.size.height);
                for (int i = -1; i <= 1; ++i) {
                    const int cx = std::clamp(bx + i, 0, back.size.width - 1);
                    const int cy = std::clamp(by + i, 0, back.size.height - 1);
                    ASSERT_EQ(all.flow.backward()[cy][cx].x, back[cy][cx].x) << cx << ", " << cy;
                    ASSERT_EQ(all.flow.backward()[cy][cx].y, back[cy][cx].y) << cx << ", " << cy;
                }
            } else {
                left += got.texture == 0 ? 1 : 0;
                EXPECT_NEAR(got.x, 5.3F, 5)
                    << "a skipped cell must have the coarser level's vector";
            }
        }
    EXPECT_GT(same, 300);
    EXPECT_GT(left, 300) << "the test needs skipped cells";
}

TEST(Flow2d, TilesThatDidNotChangeKeepTheirVectors) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {3, 1}));
    pair.run();
    const std::vector<FlowCell> before(pair.flow.forward()[0], pair.flow.forward()[0] + 1200);
    pair.work.draw = TileWork::Draw::Tiles;
    for (TileWork::Tile& tile : pair.work.flags)
        tile.changed = 0;
    pair.work.flags[33].changed = 1;
    pair.run(true);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            if (pair.work.at(x / 4, y / 4).changed == 0) {
                EXPECT_EQ(before[40UL * y + x].x, pair.flow.forward()[y][x].x);
            }
    pair.run(false);  // as after a new still, which makes earlier results invalid
    EXPECT_LT(errorsOf(pair.flow.forward(), {3, 1}, 3).worst, 0.3);
}

std::vector<Cell> seedsAround(const Vector2d& flow, double noise) {
    std::mt19937 random(3);
    std::normal_distribution<double> off(0, noise);
    std::vector<Cell> out(40UL * 30);
    for (Cell& c : out)
        c = {static_cast<float>(flow.x() + off(random)), static_cast<float>(flow.y() + off(random)),
             0, 0};
    return out;
}

TEST(Flow2d, RefinementImprovesTheGivenVectors) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {4.3, -2.2}));
    pair.refine(seedsAround({4.3, -2.2}, 0.3), std::vector<Cell>(1200));
    EXPECT_TRUE(pair.flow.errorsGiven());
    EXPECT_LE(pair.flow.searchedCount(), 2)
        << "only tiles that the other picture does not show may be searched";
    const Errors e = errorsOf(pair.flow.forward(), {4.3, -2.2}, 4);
    EXPECT_LT(e.mean, 0.05);
    EXPECT_LT(e.worst, 0.3);
    pair.run();
    EXPECT_FALSE(pair.flow.errorsGiven());
}

TEST(Flow2d, WithoutMatchedTilesVectorsAndTwoWayErrorsAreKept) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {1, 0}));
    const auto matchNothing = [&](bool refined) {
        const int matched = std::exchange(pair.work.matched, 0);
        const float before = pair.flow.forward()[15][20].x;
        if (refined)
            pair.refine(seedsAround({4, 0}, 0.1), std::vector<Cell>(1200));
        else
            pair.run();
        pair.work.matched = matched;
        EXPECT_EQ(pair.flow.forward()[15][20].x, before);
    };
    pair.refine(seedsAround({1, 0}, 0.1), std::vector<Cell>(1200));
    matchNothing(false);
    EXPECT_TRUE(pair.flow.errorsGiven()) << "refine() wrote the kept values";
    pair.run();
    matchNothing(true);
    EXPECT_FALSE(pair.flow.errorsGiven()) << "run() wrote the kept values";
}

TEST(Flow2d, InvalidGivenVectorsAreIgnored) {
    Pair pair(wavesMoved(kSmall, {0, 0}), wavesMoved(kSmall, {1, 1}));
    std::vector<Cell> seeds = seedsAround({1, 1}, 0.1);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < seeds.size(); i += 3)
        seeds[i] = {i % 2 != 0 ? kNan : kInfinite, i % 5 != 0 ? -kInfinite : 1e30F, kNan, kNan};
    for (std::size_t tile = 0; tile < pair.work.flags.size(); tile += 5)
        pair.work.flags[tile].matched = 0;
    pair.refine(seeds, std::vector<Cell>(seeds.size(), {kNan, 0, 0, 0}));
    expectBounded(pair.flow.forward(), 200);
}

TEST(Flow2d, FlowOfMovingObjectsIsSearched) {
    constexpr Size kVideo{320, 240};
    constexpr int kFirst = 96, kEnd = 176, kBy = 12;
    const FlowPicture now = wavesMoved(kVideo, {0, 0});
    FlowPicture then = now;
    const FlowPicture square = wavesMoved(kVideo, {0, kBy});
    for (int y = kFirst + kBy; y < kEnd + kBy; ++y)
        for (int x = kFirst; x < kEnd; ++x)
            then.at(x, y) = square.pixels[static_cast<std::size_t>(y) * kVideo.width + x];
    Pair pair(now, then);
    const std::vector<Cell> still(80UL * 60);
    pair.refine(still, still);
    const auto within = [](int cell, int border) {
        return 4 * cell + 2 >= kFirst + border && 4 * cell + 2 < kEnd - border;
    };
    EXPECT_EQ(pair.flow.searchedCount(),
              std::count(pair.flow.searchedTiles().begin(), pair.flow.searchedTiles().end(), true));
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const bool searched =
                pair.flow.searchedTiles()[static_cast<std::size_t>(y / 4 * 20 + x / 4)];
            const FlowCell& c = pair.flow.forward()[y][x];
            if (within(x, 16) && within(y, 16)) {
                EXPECT_TRUE(searched) << x << ", " << y;
                EXPECT_NEAR(c.x, 0, 0.2) << x << ", " << y;
                EXPECT_NEAR(c.y, kBy, 0.2) << x << ", " << y;
                EXPECT_LT(pair.flow.errors()[y][x].error, 0.5) << x << ", " << y;
            } else if (!within(x, -36) || !within(y, -36)) {
                EXPECT_FALSE(searched) << x << ", " << y;
                EXPECT_NEAR(c.x, 0, 0.05) << x << ", " << y;
                EXPECT_NEAR(c.y, 0, 0.05) << x << ", " << y;
                EXPECT_EQ(pair.flow.errors()[y][x].error, 0) << x << ", " << y;
            }
        }
}

}  // namespace
}  // namespace mfar::simd
