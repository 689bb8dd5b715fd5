#include "pipeline/simd/flow_field.h"
#include "pipeline/simd/patch_flow.h"
#include "tests/engine/simd/flow_pictures.h"
#include "tests/oracle/patch.h"

#include <gtest/gtest.h>

namespace mfar::simd {
namespace {

using Eigen::Vector2d;

// Tolerance of costs: pixels are compared in units of 1/32 grey level.
constexpr double kTolerance = 2e-3;
constexpr Size kSize{61, 45};
constexpr Size kCells{16, 12};

class Level {
public:
    explicit Level(const FlowPicture& p)
        : rows_({p.size.width + 19, p.size.height}), size_(p.size) {
        const twin::Grey grey = greyOf(p);
        for (int y = 0; y < p.size.height; ++y)
            for (int x = -8; x < p.size.width + 11; ++x)
                rows_[y][x + 8] = static_cast<std::uint8_t>(grey.at(x, y));
    }
    [[nodiscard]] PatchPicture picture() const {
        return {rows_[0] + 8, rows_.pitch(), size_.width, size_.height};
    }

private:
    AlignedRows<std::uint8_t> rows_;
    Size size_;
};

/// Random vectors of up to `reach` px along each axis, four floats per cell. Every eighth vector is
/// 40 times as long.
std::vector<float> randomVectors(unsigned seed, float reach) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> flow(-reach, reach);
    std::vector<float> out(4UL * kCells.width * kCells.height);
    for (std::size_t i = 0; i < out.size(); i += 4) {
        const float far = i % 32 == 0 ? 40.0F : 1.0F;
        out[i] = far * flow(random);
        out[i + 1] = far * flow(random);
    }
    return out;
}

FlowField searched(const Level& a, const Level& b, const std::vector<float>& vectors, int steps) {
    FlowField out(kCells), coarser({8, 6});
    SearchStep step;
    step.from = a.picture();
    step.to = b.picture();
    step.out = out.planes();
    step.coarser = coarser.planes();
    step.prior = {vectors.data(), vectors.data() + 1, 4, 4 * kCells.width, 1, 1, 1};
    step.steps = steps;
    for (int row = 0; row < kCells.height; ++row)
        searchCells(step, row, 0, kCells.width);
    return out;
}

void expectCostsOf(const FlowPicture& first, const FlowPicture& second) {
    const auto vectors = randomVectors(4, 9);
    const twin::Grey a = greyOf(first), b = greyOf(second);
    FlowField out = searched(Level(first), Level(second), vectors, 0);
    const FlowPlanes field = out.planes();
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const float* v = &vectors[4UL * (1UL * y * kCells.width + x)];
            const auto m = twin::comparePatch(a, b, x, y, {v[0], v[1]});
            const std::ptrdiff_t at = y * field.pitch + x;
            EXPECT_EQ(field.x[at], v[0]);
            EXPECT_NEAR(field.cost[at], m.cost, kTolerance) << x << ", " << y;
            EXPECT_NEAR(field.texture[at], m.varianceA, 1e-4 * (m.varianceA + 1)) << x << ", " << y;
        }
}

TEST(PatchFlow, MatchingCostAndTextureMatchTheOracle) {
    expectCostsOf(wavesMoved(kSize, {0, 0}), noiseOf(kSize, 3));
    expectCostsOf(noiseOf(kSize, 5), wavesMoved(kSize, {0, 0}));
    FlowPicture chess(kSize);  // gives the largest possible sums
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            chess.at(x, y) = (x / 2 + y / 2) % 2 != 0 ? 255 : 0;
    expectCostsOf(chess, chess);
}

TEST(PatchFlow, OneGaussNewtonStepMatchesTheOracle) {
    const FlowPicture first = wavesMoved(kSize, {0, 0}), second = wavesMoved(kSize, {1.3, -0.6});
    const auto vectors = randomVectors(5, 1);
    const twin::Grey a = greyOf(first), b = greyOf(second);
    FlowField out = searched(Level(first), Level(second), vectors, 1);
    const FlowPlanes field = out.planes();
    int taken = 0;
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const float* v = &vectors[4UL * (1UL * y * kCells.width + x)];
            const Vector2d u(v[0], v[1]);
            const auto before = twin::comparePatch(a, b, x, y, u);
            const Vector2d next = u + before.step;
            const auto after = twin::comparePatch(a, b, x, y, next);
            if (std::abs(after.cost - before.cost) < 1e-3) continue;
            const bool falls = after.cost < before.cost;
            taken += falls ? 1 : 0;
            const std::ptrdiff_t at = y * field.pitch + x;
            EXPECT_NEAR(field.x[at], falls ? next.x() : u.x(), 5e-3) << x << ", " << y;
            EXPECT_NEAR(field.y[at], falls ? next.y() : u.y(), 5e-3) << x << ", " << y;
        }
    EXPECT_GT(taken, kCells.width * kCells.height / 2);
}

// The second picture shows what lies beyond the border of the first one.
TEST(PatchFlow, PatchesAtTheBorderDoNotExtendBeyondThePicture) {
    const FlowPicture first = wavesMoved(kSize, {0, 0});
    for (const auto& [dx, dy] : {std::pair{3, 3}, {-3, -3}}) {
        const FlowPicture second = wavesMoved(kSize, {1.0 * dx, 1.0 * dy});
        std::vector<float> vectors;
        for (int i = 0; i < kCells.width * kCells.height; ++i)
            vectors.insert(vectors.end(), {1.0F * dx, 1.0F * dy, 0, 0});
        FlowField out = searched(Level(first), Level(second), vectors, 0);
        const FlowPlanes field = out.planes();
        const int left = dx > 0 ? 0 : 2, right = dx > 0 ? kCells.width - 3 : kCells.width;
        const int top = dy > 0 ? 0 : 2, bottom = dy > 0 ? kCells.height - 3 : kCells.height;
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x)
                EXPECT_LT(field.cost[y * field.pitch + x], 0.01) << x << ", " << y;
    }
}

TEST(PatchFlow, AtTheCoarsestLevelTheSearchFindsWholePixels) {
    const FlowPicture first = wavesMoved(kSize, {0, 0}), second = wavesMoved(kSize, {-7, 5});
    const Level a(first), b(second);
    FlowField out(kCells);
    SearchStep step;
    step.from = a.picture();
    step.to = b.picture();
    step.out = out.planes();
    step.radius = 8;
    for (int row = 0; row < kCells.height; ++row)
        searchCells(step, row, 0, kCells.width);
    const FlowPlanes field = out.planes();
    for (int y = 1; y < kCells.height - 3; ++y)
        for (int x = 3; x < kCells.width - 2; ++x) {
            EXPECT_EQ(field.x[y * field.pitch + x], -7) << x << ", " << y;
            EXPECT_EQ(field.y[y * field.pitch + x], 5) << x << ", " << y;
        }
}

TEST(PatchFlow, ACellTakesTheBestVectorOfItsNeighbours) {
    const FlowPicture first = wavesMoved(kSize, {0, 0}), second = wavesMoved(kSize, {4, 2});
    const Level a(first), b(second);
    const twin::Grey greyA = greyOf(first), greyB = greyOf(second);
    FlowField in = searched(a, b, randomVectors(6, 6), 0), out(kCells);
    const PropagateStep step{a.picture(), b.picture(), out.planes(), in.planes(), 0};
    for (int row = 0; row < kCells.height; ++row)
        propagateCells(step, row, 0, kCells.width);
    int moved = 0;
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const auto index = [&](int cx, int cy) {
                return std::clamp(cy, 0, kCells.height - 1) * step.in.pitch +
                       std::clamp(cx, 0, kCells.width - 1);
            };
            double least = step.in.cost[index(x, y)];
            Vector2d best(step.in.x[index(x, y)], step.in.y[index(x, y)]);
            for (const std::ptrdiff_t at :
                 {index(x - 1, y), index(x + 1, y), index(x, y - 1), index(x, y + 1)}) {
                const Vector2d u(step.in.x[at], step.in.y[at]);
                if ((u - best).norm() < 0.5) continue;
                const double cost = twin::comparePatch(greyA, greyB, x, y, u).cost;
                if (cost < least) best = u;
                least = std::min(least, cost);
            }
            const std::ptrdiff_t at = index(x, y);
            EXPECT_NEAR(step.out.cost[at], least, kTolerance) << x << ", " << y;
            EXPECT_EQ(step.out.texture[at], step.in.texture[at]);
            moved += step.out.x[at] != step.in.x[at] ? 1 : 0;
        }
    EXPECT_GT(moved, kCells.width * kCells.height / 4);
}

/// Checks the costs of bent patches: the flow changes by dx and dy per pixel. `span`: see
/// compareBentPatch().
void expectBentCosts(const Vector2d& dx, const Vector2d& dy, int span) {
    const FlowPicture first = wavesMoved(kSize, {0, 0}), second = noiseOf(kSize, 3);
    const Level a(first), b(second);
    const twin::Grey greyA = greyOf(first), greyB = greyOf(second);
    std::vector<float> seeds(4UL * kCells.width * kCells.height);
    for (int i = 0; i < kCells.width * kCells.height; ++i) {
        const Vector2d u = Vector2d(-3.123, 1.417) + 4 * (i % kCells.width - 8) * dx +
                           4 * (i / kCells.width - 6) * dy;
        seeds[4UL * i] = static_cast<float>(u.x());
        seeds[4UL * i + 1] = static_cast<float>(u.y());
    }
    FlowField out(kCells);
    const AlignStep step{a.picture(), b.picture(), out.planes(), seeds.data(), 0};
    for (int row = 0; row < kCells.height; ++row)
        alignCells(step, row, 0, kCells.width);
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const float* v = &seeds[4UL * (1UL * y * kCells.width + x)];
            const auto m = twin::compareBentPatch(greyA, greyB, x, y, {v[0], v[1]}, dx, dy, span);
            EXPECT_NEAR(step.out.cost[y * step.out.pitch + x], m.cost, kTolerance)
                << x << ", " << y;
        }
}

TEST(PatchFlow, CostsOfBentPatchesMatchTheOracle) {
    expectBentCosts({0.0637, -0.0613}, {0.0419, 0.1931}, 8);
    expectBentCosts({0.1837, -0.0613}, {0.0419, 0.1931}, 4);
}

TEST(PatchFlow, FilteringOfFlowKeepsPlanesAndTheStepBetweenThem) {
    FlowField in(kCells);
    AlignedRows<float> known(FlowField::withMargins(kCells));
    const FlowPlanes field = in.planes();
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const std::ptrdiff_t at = y * field.pitch + x;
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            field.x[at] = x < 8 ? 0.1F * fx - 0.05F * fy : 9 + 0.05F * fx;
            field.y[at] = x < 8 ? 0.2F * fy : -4;
            field.texture[at] = 1e5F;
        }
    for (int y = 0; y < kCells.height; ++y)
        prepareCleanUpRow(field, FlowField::first(known), y);
    std::vector<float> out(4UL * kCells.width * kCells.height);
    const CleanUpStep step{field, FlowField::first(known), out.data(), 2};
    for (int y = 2; y < kCells.height - 2; ++y)  // without cells that the border affects
        cleanUpCells(step, y, 2, kCells.width - 2);
    for (int y = 2; y < kCells.height - 2; ++y)
        for (int x = 2; x < kCells.width - 2; ++x) {
            const std::size_t at = 4UL * (1UL * y * kCells.width + x);
            EXPECT_NEAR(out[at], field.x[y * field.pitch + x], 5e-3) << x << ", " << y;
            EXPECT_NEAR(out[at + 1], field.y[y * field.pitch + x], 5e-3) << x << ", " << y;
        }
}

TEST(PatchFlow, FilteringOfFlowRemovesALoneOutlier) {
    FlowField in(kCells);
    AlignedRows<float> known(FlowField::withMargins(kCells));
    const FlowPlanes field = in.planes();
    field.x[5 * field.pitch + 7] = 9;
    for (int y = 0; y < kCells.height; ++y)
        prepareCleanUpRow(field, FlowField::first(known), y);
    std::vector<float> out(4UL * kCells.width * kCells.height, 99);
    cleanUpCells({field, FlowField::first(known), out.data(), 2}, 5, 3, 10);
    const float* row = &out[4UL * 5 * kCells.width];
    EXPECT_EQ(row[4 * 7], 0);
    EXPECT_EQ(row[4 * 2], 99) << "cleanUpCells() wrote left of its cells";
    EXPECT_EQ(row[4 * 10], 99) << "cleanUpCells() wrote right of its cells";
}

}  // namespace
}  // namespace mfar::simd
