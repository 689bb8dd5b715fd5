#include "pipeline/simd/turned_rows.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace mfar::simd {
namespace {

TEST(TurnedPoints, PointsAreProjectionsOfRotatedRays) {
    const TurnedLens lens{test::barrel(), test::smallTurn(), 0.7F};
    for (const std::size_t count : test::kLengths) {
        auto raysX = test::randomValues<float>(count, -0.8, 0.8, 1);
        const auto raysY = test::randomValues<float>(count, -0.8, 0.8, 2);
        raysX[count / 2] = std::numeric_limits<float>::quiet_NaN();
        std::vector<float> x(count), y(count);
        turnedPoints(lens, raysX.data(), raysY.data(), count, x.data(), y.data());
        for (std::size_t i = 0; i < count; ++i) {
            const auto p = test::turned(lens.turn, {raysX[i], raysY[i], 1});
            const double radius = std::hypot(p.x, p.y) / p.z;
            if (std::abs(radius - lens.rim) < 1e-4) continue;
            if (!(radius < lens.rim)) {
                EXPECT_LT(x[i], -1e5F);
                continue;
            }
            const auto q = test::project(lens.lens, p.x / p.z, p.y / p.z);
            EXPECT_NEAR(x[i], q.x, 1e-3);
            EXPECT_NEAR(y[i], q.y, 1e-3);
        }
    }
}

TEST(TurnedRow, ARotatedPictureIsInterpolatedInsideAndMarkedUnseenOutside) {
    for (const Size size : {Size{2, 2}, Size{3, 2}, Size{40, 31}}) {
        for (const int width : {1, 8, 23, 80}) {
            const std::ptrdiff_t pitch = size.width + 3;
            const auto bytes = static_cast<std::size_t>((size.height - 1) * pitch + size.width);
            const auto picture = test::randomValues<std::uint8_t>(bytes, 0, 255.9, 3);
            const std::size_t cells = width / kTurnedCell + 2;
            std::vector<float> x(cells), y(cells), nextX(cells), nextY(cells);
            for (std::size_t c = 0; c < cells; ++c) {
                const float way = static_cast<float>(c) / static_cast<float>(cells - 1);
                x[c] = -3 + way * static_cast<float>(size.width + 6);
                y[c] = -2 + way * static_cast<float>(size.height + 4);
                nextX[c] = x[c] + 1.5F;
                nextY[c] = y[c] - 1;
            }
            std::vector<std::uint8_t> grey(width + 1, 99), seen(width + 1, 99);
            const float v = 0.375F;
            turnedRow({picture.data(), pitch, size},
                      {x.data(), y.data(), nextX.data(), nextY.data()}, v, width, grey.data(),
                      seen.data());
            EXPECT_EQ(grey[width], 99);
            EXPECT_EQ(seen[width], 99);
            for (int i = 0; i < width; ++i) {
                const int c = i / kTurnedCell;
                const double u = static_cast<double>(i % kTurnedCell) / kTurnedCell;
                const auto at = [&](const std::vector<float>& row, const std::vector<float>& next) {
                    return std::lerp(std::lerp(row[c], next[c], v),
                                     std::lerp(row[c + 1], next[c + 1], v), u);
                };
                const double px = at(x, nextX), py = at(y, nextY);
                const double lastX = size.width - 1.0, lastY = size.height - 1.0;
                const double out =
                    std::max({-0.5 - px, -0.5 - py, px - lastX - 0.5, py - lastY - 0.5});
                if (std::abs(out) > 0.01) {
                    ASSERT_EQ(seen[i], out < 0 ? 1 : 0) << i;
                }
                const double sx = std::clamp(px, 0.0, lastX), sy = std::clamp(py, 0.0, lastY);
                const int ix = std::min(static_cast<int>(sx), size.width - 2);
                const int iy = std::min(static_cast<int>(sy), size.height - 2);
                const std::uint8_t* p = picture.data() + iy * pitch + ix;
                const double expected =
                    std::lerp(std::lerp(p[0], p[1], sx - ix),
                              std::lerp(p[pitch], p[pitch + 1], sx - ix), sy - iy);
                ASSERT_NEAR(grey[i], expected, 0.8) << i;
            }
        }
    }
}

}  // namespace
}  // namespace mfar::simd
