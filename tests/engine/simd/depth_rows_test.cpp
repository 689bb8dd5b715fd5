#include "pipeline/simd/depth_rows.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace mfar::simd {
namespace {

constexpr Size kPicture{100, 80};
constexpr float kInfinity = std::numeric_limits<float>::infinity();
using Row = std::vector<float>;

/// Index of the pixel, row by row; -1: the point is invalid or outside the picture; -2: rounding
/// decides which pixel it is.
int pixelOf(const test::Ray& p, bool valid) {
    if (!valid) return -1;
    if (test::isBetween(p.x) || test::isBetween(p.y)) return -2;
    const double x = std::floor(p.x + 0.5), y = std::floor(p.y + 0.5);
    const bool inside = x >= 0 && y >= 0 && x < kPicture.width && y < kPicture.height;
    return inside ? static_cast<int>(y) * kPicture.width + static_cast<int>(x) : -1;
}

TEST(LandRow, FindsThePixelOfAPointInTheSecondPicture) {
    const Lens lens = test::barrel();
    const Motion motion{test::smallTurn(), {0.4F, -0.2F, 0.3F}};
    for (const std::size_t count : test::kLengths) {
        const Row x = test::randomValues<float>(count, -0.6, 0.6, 1);
        const Row y = test::randomValues<float>(count, -0.6, 0.6, 2);
        Row s = test::randomValues<float>(count, -0.1, 0.6, 3);
        s[count / 2] = std::numeric_limits<float>::quiet_NaN();
        std::vector<std::int32_t> landing(count);
        landRow(lens, kPicture, motion, x.data(), y.data(), s.data(), count, landing.data());
        for (std::size_t i = 0; i < count; ++i) {
            if (i == count / 2) {
                EXPECT_EQ(landing[i], -1) << "a NaN depth must land nowhere";
                continue;
            }
            const auto& t = motion.move;
            const auto p = test::turned(motion.turn, {x[i] + s[i] * (t[0] - x[i] * t[2]),
                                                      y[i] + s[i] * (t[1] - y[i] * t[2]), 1});
            const int expected = pixelOf(test::project(lens, p.x / p.z, p.y / p.z), true);
            if (expected == -2) continue;
            EXPECT_EQ(landing[i], expected);
        }
    }
}

TEST(MoveRow, MovesPointsAndTheirVariance) {
    const Lens lens = test::barrel();
    const Motion motion{test::smallTurn(), {0.1F, -0.05F, -0.3F}};
    const MoveRule rule{0.01F, 0.02F, 0.05F, 0.001F};
    for (const std::size_t count : test::kLengths) {
        const Row raysX = test::randomValues<float>(count, -0.6, 0.6, 1);
        const Row raysY = test::randomValues<float>(count, -0.6, 0.6, 2);
        const Row x = test::randomValues<float>(count, -0.5, 0.5, 3);
        const Row y = test::randomValues<float>(count, -0.5, 0.5, 4);
        const Row inverseDepth = test::randomValues<float>(count, 0, 4, 5);
        Row variance = test::randomValues<float>(count, 0.01, 0.1, 6);
        for (std::size_t i = 0; i < count; i += 4)
            variance[i] = kInfinity;
        std::vector<std::int32_t> pixel(count);
        Row toX(count), toY(count), toInverseDepth(count), toVariance(count);
        PixelRect bounds;
        moveRow(
            lens, kPicture, motion, rule,
            {raysX.data(), raysY.data(), x.data(), y.data(), inverseDepth.data(), variance.data()},
            count, {pixel.data(), toX.data(), toY.data(), toInverseDepth.data(), toVariance.data()},
            bounds);
        PixelRect expectedBounds;
        for (std::size_t i = 0; i < count; ++i) {
            if (pixel[i] >= 0) {
                const int column = pixel[i] % kPicture.width, row = pixel[i] / kPicture.width;
                expectedBounds = around(expectedBounds, {column, row, column + 1, row + 1});
            }
            const auto turned = test::turned(
                motion.turn, {raysX[i] + rule.pixelX * x[i], raysY[i] + rule.pixelY * y[i], 1});
            const double z = turned.z + inverseDepth[i] * motion.move[2];
            const auto q = test::project(lens, (turned.x + inverseDepth[i] * motion.move[0]) / z,
                                         (turned.y + inverseDepth[i] * motion.move[1]) / z);
            // Near the smallest valid depth, rounding decides whether the point is valid.
            if (std::abs(z - rule.leastDepth) < 0.05) continue;
            const int expected = pixelOf(q, variance[i] < kInfinity && z > rule.leastDepth);
            if (expected == -2) continue;
            ASSERT_EQ(pixel[i], expected) << i << " of " << count;
            if (expected < 0) continue;
            const double slope = turned.z / (z * z);
            ASSERT_NEAR(toInverseDepth[i], inverseDepth[i] / z, 1e-4 * inverseDepth[i] / z + 1e-6);
            const double grown = variance[i] + rule.growth * inverseDepth[i] * inverseDepth[i];
            ASSERT_NEAR(toVariance[i], grown * slope * slope, 1e-4 * grown * slope * slope);
            ASSERT_NEAR(toX[i], q.x - expected % kPicture.width, 2e-3);
            const int row = expected / kPicture.width;
            ASSERT_NEAR(toY[i], q.y - row, 2e-3);
        }
        EXPECT_EQ(bounds, expectedBounds);
    }
}

TEST(MeasureRow, OnlyVisiblePointsGetDepthAndVariance) {
    const MeasureRule rule{{0.3F, 0.1F, 0.5F}, 0.05F, 0.05F, 0.003F, 2};
    for (const std::size_t count : test::kLengths) {
        const Row raysX = test::randomValues<float>(count, -0.6, 0.6, 1);
        const Row raysY = test::randomValues<float>(count, -0.6, 0.6, 2);
        const Row s = test::randomValues<float>(count, -0.2, 2.5, 3);
        const Row nearest = test::randomValues<float>(7, 0, 1, 4);
        const auto landing = test::randomValues<std::int32_t>(count, -1.99, 6.9, 5);  // -1 to 6
        Row inverseDepth(count), variance(count);
        measureRow({raysX.data(), raysY.data(), s.data(), landing.data(), nearest.data()}, rule,
                   count, inverseDepth.data(), variance.data());
        for (std::size_t i = 0; i < count; ++i) {
            const double depth = 1 - static_cast<double>(s[i]) * rule.t[2];
            const bool known = landing[i] >= 0 && s[i] + rule.slack >= nearest[landing[i]] &&
                               depth > rule.leastDepth;
            if (!known) {
                EXPECT_EQ(inverseDepth[i], 0);
                EXPECT_EQ(variance[i], kInfinity);
                continue;
            }
            const double way =
                std::hypot(rule.t[0] - raysX[i] * rule.t[2], rule.t[1] - raysY[i] * rule.t[2]);
            const double sigma = rule.error / way / (depth * depth) * rule.perUnit;
            EXPECT_NEAR(inverseDepth[i], std::max(s[i] / depth * rule.perUnit, 0.0),
                        1e-4 * (1 + inverseDepth[i]));
            EXPECT_NEAR(variance[i], sigma * sigma, 1e-3 * sigma * sigma);
        }
    }
}

TEST(TakeCells, DepthOfCellsIsInterpolatedWhereCellsAgreeWithThePixel) {
    for (const Size cells : {Size{1, 1}, Size{1, 3}, Size{10, 6}}) {
        const Row field = test::randomValues<float>(
            static_cast<std::size_t>(cells.width) * cells.height, 0, 1, 1);
        const int width = 4 * cells.width;
        for (int y = 0; y < 4 * cells.height; ++y) {
            const Row own = test::randomValues<float>(width, 0, 1, 2 + y);
            Row out(width);
            takeCells({field.data(), cells}, 0, y, own.data(), 0.3F, width, out.data());
            for (int x = 0; x < width; ++x) {
                const double u = std::clamp((x - 1.5) / 4, 0.0, cells.width - 1.0);
                const double v = std::clamp((y - 1.5) / 4, 0.0, cells.height - 1.0);
                const auto at = [&](int i, int j) {
                    return static_cast<double>(field[std::min(j, cells.height - 1) * cells.width +
                                                     std::min(i, cells.width - 1)]);
                };
                const int i = static_cast<int>(u), j = static_cast<int>(v);
                const double s = std::lerp(std::lerp(at(i, j), at(i + 1, j), u - i),
                                           std::lerp(at(i, j + 1), at(i + 1, j + 1), u - i), v - j);
                if (std::abs(std::abs(s - own[x]) - 0.3) < 1e-4) continue;
                ASSERT_NEAR(out[x], std::abs(s - own[x]) < 0.3 ? s : own[x], 1e-5);
            }
        }
    }
}

}  // namespace
}  // namespace mfar::simd
