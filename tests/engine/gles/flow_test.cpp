#include "pipeline/gles/flow2d.h"
#include "pipeline/pipeline.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/levels.h"
#include "tests/oracle/patch.h"
#include "tests/oracle/plane_filter.h"

#include <array>

namespace mfar {
namespace {

using FlowPasses = GlTest;
using Eigen::Vector2d;

// Absolute tolerance of a cell's cost, and relative tolerance of its texture. The shader computes
// cost and texture in single precision from sums of 64 squared differences.
constexpr double kTolerance = 2e-3;
constexpr Size kSize{61, 45};  // the border cuts the last cells
constexpr Size kCells{16, 12};
constexpr int kArea = 16 * 12;

using Cell = std::array<float, 4>;  // flow (x, y), cost, texture

params::RefineFlow refineParams(const LevelPair& pair, int steps) {
    return {.from = pair.pyramids.video()[0],
            .to = pair.pyramids.still()[0],
            .columns = kCells.width,
            .rows = kCells.height,
            .target = 0,
            .source = kArea,
            .steps = steps};
}

/// Random flow vectors of up to `reach` px along each axis. Every eighth is 40 times as long.
std::vector<Cell> randomField(unsigned seed, float reach) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> flow(-reach, reach);
    std::vector<Cell> out(kArea);
    for (int i = 0; i < kArea; ++i) {
        const float far = i % 8 == 0 ? 40.0F : 1.0F;
        out[i] = {far * flow(random), far * flow(random), 0, 0};
    }
    return out;
}

/// Runs flow_search.comp with `steps` Gauss-Newton steps. The vectors of `prior` are its only
/// candidates.
std::vector<Cell> search(const LevelPair& pair, const std::vector<Cell>& prior, int steps) {
    gpu::Buffer cells(2 * kArea * sizeof(Cell));
    cells.write(std::span(prior), kArea * sizeof(Cell));
    gpu::ComputePass<params::SearchFlow> pass("flow_search.comp");
    const params::SearchFlow p{.from = pair.pyramids.video()[0],
                               .to = pair.pyramids.still()[0],
                               .columns = kCells.width,
                               .rows = kCells.height,
                               .coarserColumns = 0,
                               .coarserRows = 0,
                               .target = 0,
                               .coarser = -1,
                               .lastFrame = kArea,
                               .lastFrameColumns = kCells.width,
                               .radius = 0,
                               .candidates = 1,
                               .steps = steps,
                               .perLastFrame = 1,
                               .lastFrameX = 1,
                               .lastFrameY = 1,
                               .firstGroup = 0,
                               .errors = -1};
    pass.run(p, {gpu::storage(0, pair.pyramids.words()), gpu::storage(1, cells)}, {4, 3, 1});
    return cells.read<Cell>(kArea);
}

TEST_F(FlowPasses, MatchingCostAndTextureMatchTheOracle) {
    const LevelPair pair(Waves(1, 5, 40, 40).shoot(kSize, {}), randomPicture(kSize, 3));
    const auto a = pair.first(), b = pair.second();
    const auto prior = randomField(4, 9);
    const auto found = search(pair, prior, 0);
    for (int i = 0; i < kArea; ++i) {
        const auto m = twin::comparePatch(a, b, i % 16, i / 16, {prior[i][0], prior[i][1]});
        EXPECT_EQ(found[i][0], prior[i][0]);
        EXPECT_NEAR(found[i][2], m.cost, kTolerance) << "cell " << i;
        EXPECT_NEAR(found[i][3], m.varianceA, kTolerance * (m.varianceA + 1)) << "cell " << i;
    }
}

// The second picture shows what lies beyond the border of the first one.
TEST_F(FlowPasses, PatchesAtTheBorderDoNotExtendBeyondThePicture) {
    const Waves waves(2, 10, 60, 40);
    for (const auto& [dx, dy] : {std::pair{3, 3}, {-3, -3}}) {
        const LevelPair pair(waves.shoot(kSize, {}),
                             waves.shoot(kSize, {.shift = {1.0 * dx, 1.0 * dy}}));
        const std::vector<Cell> prior(kArea, Cell{-1.0F * dx, -1.0F * dy, 0, 0});
        const auto found = search(pair, prior, 0);
        const int left = dx < 0 ? 0 : 2, right = dx < 0 ? kCells.width - 3 : kCells.width;
        const int top = dy < 0 ? 0 : 2, bottom = dy < 0 ? kCells.height - 3 : kCells.height;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                EXPECT_LT(found[y * kCells.width + x][2], 0.01) << x << ", " << y;
    }
}

TEST_F(FlowPasses, OneGaussNewtonStepMatchesTheOracle) {
    const Waves waves(2, 10, 60, 40);
    const LevelPair pair(waves.shoot(kSize, {}), waves.shoot(kSize, {.shift = {1.3, -0.6}}));
    const auto a = pair.first(), b = pair.second();
    const auto prior = randomField(5, 1);
    const auto found = search(pair, prior, 1);
    int taken = 0;
    for (int i = 0; i < kArea; ++i) {
        const Vector2d u(prior[i][0], prior[i][1]);
        const auto before = twin::comparePatch(a, b, i % 16, i / 16, u);
        const Vector2d next = u + before.step;
        const auto after = twin::comparePatch(a, b, i % 16, i / 16, next);
        if (std::abs(after.cost - before.cost) < 1e-4) continue;
        const bool falls = after.cost < before.cost;
        taken += falls ? 1 : 0;
        EXPECT_NEAR(found[i][0], falls ? next.x() : u.x(), 5e-3) << "cell " << i;
        EXPECT_NEAR(found[i][1], falls ? next.y() : u.y(), 5e-3) << "cell " << i;
    }
    EXPECT_GT(taken, kArea / 2);
}

TEST_F(FlowPasses, ACellTakesTheBestVectorOfItsNeighbours) {
    const Waves waves(3, 6, 60, 40);
    const LevelPair pair(waves.shoot(kSize, {}), waves.shoot(kSize, {.shift = {4, 2}}));
    const auto a = pair.first(), b = pair.second();
    const auto in = search(pair, randomField(6, 6), 0);
    gpu::Buffer cells(2 * kArea * sizeof(Cell));
    cells.write(std::span(in), kArea * sizeof(Cell));
    gpu::ComputePass<params::RefineFlow> pass("flow_propagate.comp");
    pass.run(refineParams(pair, 0),
             {gpu::storage(0, pair.pyramids.words()), gpu::storage(1, cells)}, {4, 3, 1});
    const auto out = cells.read<Cell>(kArea);
    const auto cellAt = [&](int x, int y) {
        return in[std::clamp(y, 0, kCells.height - 1) * kCells.width +
                  std::clamp(x, 0, kCells.width - 1)];
    };
    int moved = 0;
    for (int i = 0; i < kArea; ++i) {
        const int x = i % 16, y = i / 16;
        Cell best = in[i];
        for (const Cell& n :
             {cellAt(x - 1, y), cellAt(x + 1, y), cellAt(x, y - 1), cellAt(x, y + 1)}) {
            if (std::hypot(n[0] - best[0], n[1] - best[1]) < 0.5) continue;
            const double cost = twin::comparePatch(a, b, x, y, {n[0], n[1]}).cost;
            if (cost < best[2]) best = {n[0], n[1], static_cast<float>(cost), 0};
        }
        EXPECT_NEAR(out[i][2], best[2], kTolerance) << "cell " << i;
        moved += out[i][0] != in[i][0] ? 1 : 0;
    }
    EXPECT_GT(moved, kArea / 4);
}

std::vector<Cell> align(const LevelPair& pair, const std::vector<Cell>& in, int steps) {
    gpu::Buffer cells(2 * kArea * sizeof(Cell));
    cells.write(std::span(in), kArea * sizeof(Cell));
    gpu::ComputePass<params::RefineFlow> pass("flow_align.comp");
    pass.run(refineParams(pair, steps),
             {gpu::storage(0, pair.pyramids.words()), gpu::storage(1, cells),
              gpu::storage(2, pair.tiles.buffer())},
             {4, 3, 1});
    return cells.read<Cell>(kArea);
}

// A patch is bent if the flow changes within it, see compareBentPatch().
TEST_F(FlowPasses, CostsOfBentPatchesMatchTheOracle) {
    const LevelPair pair(Waves(1, 5, 40, 40).shoot(kSize, {}), randomPicture(kSize, 3));
    const auto a = pair.first(), b = pair.second();
    const Vector2d dx(0.1137, -0.0613), dy(0.0419, 0.1931);
    std::vector<Cell> in(kArea);
    for (int i = 0; i < kArea; ++i) {
        const Vector2d u =
            Vector2d(-7.123, 3.417) + 4 * (i % 16) * dx - 4 * std::abs(i / 16 - 6) * dy;
        in[i] = {static_cast<float>(u.x()), static_cast<float>(u.y()), 0, 0};
    }
    const auto out = align(pair, in, 0);
    for (int i = 0; i < kArea; ++i) {
        const int x = i % 16, y = i / 16;
        // Along each axis, the shader computes two slopes of the flow: one between the cell and the
        // second cell before it, one between the cell and the second cell after it. It uses the
        // smaller slope, or 0 if the signs differ. A cell at the border has the slope of the
        // nearest cell for which both slopes exist.
        const Vector2d alongY = std::abs(y - 6) <= 1 ? Vector2d(0, 0) : y < 6 ? dy : Vector2d(-dy);
        const auto m = twin::compareBentPatch(a, b, x, y, {in[i][0], in[i][1]}, dx, alongY);
        EXPECT_EQ(out[i][0], in[i][0]);
        EXPECT_NEAR(out[i][2], m.cost, kTolerance) << "cell " << x << ", " << y;
        EXPECT_NEAR(out[i][3], m.varianceA, kTolerance * (m.varianceA + 1));
    }
}

// The second picture shows the surface 15 % larger.
TEST_F(FlowPasses, BentPatchesHaveLessThanHalfTheErrorOfShiftedPatchesOnALargerSurface) {
    const Waves waves(4, 5, 40, 40);
    constexpr double kStretch = 1 / 1.15;
    const LevelPair pair(waves.shoot(kSize, {}),
                         waves.shoot(kSize, {.step = kStretch, .shift = {4, 3}}));
    const auto truth = [&](int i) {
        const int x = i % 16, y = i / 16;
        const Vector2d p(4 * x + 1.5, 4 * y + 1.5);
        return Vector2d((p + Vector2d(0.5, 0.5) - Vector2d(4, 3)) / kStretch - Vector2d(0.5, 0.5) -
                        p);
    };
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.15);
    std::vector<Cell> in(kArea);
    for (int i = 0; i < kArea; ++i) {
        const Vector2d u = truth(i) + Vector2d(noise(random), noise(random));
        in[i] = {static_cast<float>(u.x()), static_cast<float>(u.y()), 0, 0};
    }
    const auto rms = [&](const std::vector<Cell>& found) {
        double sum = 0;
        int cells = 0;
        for (int i = 0; i < kArea; ++i) {
            if (i % 16 < 2 || i % 16 > 12 || i / 16 < 2 || i / 16 > 8) continue;
            sum += (Vector2d(found[i][0], found[i][1]) - truth(i)).squaredNorm();
            ++cells;
        }
        return std::sqrt(sum / cells);
    };
    const double bent = rms(align(pair, in, 2)), shifted = rms(search(pair, in, 2));
    EXPECT_LT(bent, 0.05);
    EXPECT_LT(bent, 0.5 * shifted);
}

std::vector<Cell> filtered(const std::vector<Cell>& in, int planeFits = 2) {
    gpu::Buffer cells(2 * kArea * sizeof(Cell));
    cells.write(std::span(in), kArea * sizeof(Cell));
    gpu::ComputePass<params::FilterFlow> pass("flow_filter.comp");
    pass.run({.columns = kCells.width,
              .rows = kCells.height,
              .target = 0,
              .source = kArea,
              .planeFits = planeFits,
              .byTile = 0},
             {gpu::storage(1, cells)}, {4, 3, 1});
    return cells.read<Cell>(kArea);
}

TEST_F(FlowPasses, FilteredFlowMatchesTheOracle) {
    // A small `reach` gives flow that is nearly linear in x and y, a large one unrelated vectors.
    for (const float reach : {0.2F, 0.7F, 5.0F}) {
        auto in = randomField(8, reach);
        std::mt19937 random(9);
        std::uniform_real_distribution<float> unit(0, 1);
        for (int i = 0; i < kArea; ++i) {
            in[i][0] += 0.1F * static_cast<float>(i % 16);
            in[i][2] = unit(random);
            in[i][3] = 2e4F * unit(random) * unit(random);
        }
        for (const int fits : {0, 1, 2}) {
            const auto out = filtered(in, fits);
            for (int i = 0; i < kArea; ++i) {
                const Vector2d t =
                    twin::filterCell({in, kCells.width, kCells.height}, i % 16, i / 16, fits);
                EXPECT_NEAR(out[i][0], t.x(), 2e-3) << "cell " << i << ", reach " << reach;
                EXPECT_NEAR(out[i][1], t.y(), 2e-3) << "cell " << i << ", reach " << reach;
            }
        }
    }
}

TEST_F(FlowPasses, FilteringOfFlowKeepsPlanesAndTheStepBetweenThem) {
    std::vector<Cell> in(kArea);
    for (int i = 0; i < kArea; ++i) {
        const int column = i % 16, row = i / 16;
        const auto x = static_cast<float>(column), y = static_cast<float>(row);
        in[i] = column < 8 ? Cell{0.1F * x - 0.05F * y, 0.2F * y, 0, 1e5F}
                           : Cell{9.0F + 0.05F * x, -4.0F, 0, 1e5F};
    }
    const auto out = filtered(in);
    for (int i = 0; i < kArea; ++i) {
        const int x = i % 16, y = i / 16;
        if (x < 2 || x > 13 || y < 2 || y > 9) continue;  // affected by the border
        EXPECT_NEAR(out[i][0], in[i][0], 5e-3) << "cell " << i;
        EXPECT_NEAR(out[i][1], in[i][1], 5e-3) << "cell " << i;
    }
}

}  // namespace
}  // namespace mfar
