#include "pipeline/simd/cell_flow_rows.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mfar::simd {
namespace {

using Row = std::vector<float>;

TEST(CellDepths, CellDepthIsTheMedianOfTheFourCentralPixels) {
    for (const std::size_t count : test::kLengths) {
        const Row upper = test::randomValues<float>(4 * count, -1, 1, 1);
        const Row lower = test::randomValues<float>(4 * count, -1, 1, 2);
        Row out(count);
        cellDepths(upper.data(), lower.data(), count, out.data());
        for (std::size_t i = 0; i < count; ++i) {
            Row four{upper[4 * i + 1], upper[4 * i + 2], lower[4 * i + 1], lower[4 * i + 2]};
            std::sort(four.begin(), four.end());
            ASSERT_FLOAT_EQ(out[i], 0.5F * (four[1] + four[2]));
        }
    }
}

struct Cells {
    FlowEnds ends{test::barrel(), {test::smallTurn(), {0.5F, 0.2F, -0.4F}}, 0.05F, 1e4F};
    Row raysX, raysY, middles, s;

    explicit Cells(std::size_t count)
        : raysX(test::randomValues<float>(count, -0.5, 0.5, 1)),
          raysY(test::randomValues<float>(count, -0.5, 0.5, 2)),
          middles(test::randomValues<float>(count, 0, 100, 3)),
          s(test::randomValues<float>(count, -0.1, 0.8, 4)) {}
    [[nodiscard]] CellRow row() const {
        return {raysX.data(), raysY.data(), middles.data(), 33, s.size()};
    }
    [[nodiscard]] std::vector<CellVector> flow(const Row& depths) const {
        std::vector<CellVector> out(depths.size());
        cellFlow(ends, row(), depths.data(), out.data());
        return out;
    }
};

TEST(CellFlow, FlowOfACellEndsWhereTheStillShowsItsPoint) {
    for (const std::size_t count : test::kLengths) {
        const Cells cells(count);
        const auto flow = cells.flow(cells.s);
        const auto& t = cells.ends.motion.move;
        for (std::size_t i = 0; i < count; ++i) {
            const double x = cells.raysX[i], y = cells.raysY[i], s = cells.s[i];
            const auto p = test::turned(cells.ends.motion.turn,
                                        {x + s * (t[0] - x * t[2]), y + s * (t[1] - y * t[2]), 1});
            const auto q = test::project(cells.ends.lens, p.x / p.z, p.y / p.z);
            EXPECT_NEAR(flow[i][0], q.x - cells.middles[i], 1e-2);
            EXPECT_NEAR(flow[i][1], q.y - 33, 1e-2);
            EXPECT_EQ(flow[i][2], 0);
            EXPECT_EQ(flow[i][3], 0);
        }
    }
}

TEST(CellFlow, FlowOfPointsBehindTheCameraAndOfNanDepthsEndsFarOutside) {
    Cells cells(20);
    cells.ends.motion.turn = {1, 0, 0, 0, 1, 0, 0, 0, -1};
    for (const auto& v : cells.flow(cells.s))
        EXPECT_GT(v[0], 9000);
    cells = Cells(20);
    cells.s[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_GT(cells.flow(cells.s)[7][1], 9000);
}

// Computes the flow that belongs to changed inverse depths. From this flow, alignCells() must find
// the changed inverse depths.
TEST(AlignCells, InverseDepthOfCellsFollowsTheirFlowAlongTheEpipolarLine) {
    for (const std::size_t count : test::kLengths) {
        const Cells cells(count);
        Row wanted = cells.s, found = cells.s;
        for (float& s : wanted)
            s += 0.004F;
        const auto start = cells.flow(cells.s), flow = cells.flow(wanted);
        alignCells(cells.ends, cells.row(), flow.data(), start.data(), 0.01F, 0.05F, found.data());
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_NEAR(found[i], wanted[i], 2e-4);
        found = cells.s;
        alignCells(cells.ends, cells.row(), flow.data(), start.data(), 0.01F, 1e6F, found.data());
        EXPECT_EQ(found, cells.s) << "cells whose flow hardly depends on s must keep s";
    }
}

TEST(CellLandings, ALandingIsTheCellNearestToTheEndOfTheFlow) {
    const Size cells{37, 20};
    const Row x = test::randomValues<float>(37, -60, 60, 1),
              y = test::randomValues<float>(37, -60, 60, 2);
    std::vector<CellVector> flow(37);
    for (std::size_t i = 0; i < flow.size(); ++i)
        flow[i] = {x[i], y[i], 0, 0};
    std::vector<std::int32_t> landing(37);
    cellLandings(flow.data(), 11, cells, landing.data());
    for (int i = 0; i < 37; ++i) {
        const double u = i + x[i] / 4.0, v = 11 + y[i] / 4.0;
        const bool inside = u > -0.5 && v > -0.5 && u < 36.5 && v < 19.5;
        EXPECT_EQ(landing[i], inside ? std::lround(v) * 37 + std::lround(u) : -1);
    }
}

TEST(CellsHidden, CellsBehindANearerCellWithTheSameLandingAreOccluded) {
    for (const std::size_t count : test::kLengths) {
        const auto landing = test::randomValues<std::int32_t>(count, -1.99, 4.9, 1);  // -1 to 4
        const Row nearest = test::randomValues<float>(5, 0, 1, 2),
                  s = test::randomValues<float>(count, 0, 1, 3);
        std::vector<CellVector> out(count);
        cellsHidden(landing.data(), nearest.data(), s.data(), {10, 1, 1e4F}, count, out.data());
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_NEAR(out[i][0],
                        landing[i] < 0 ? 1e4F
                                       : std::max((nearest[landing[i]] - s[i]) * 10 - 1, 0.0F),
                        1e-4);
    }
}

TEST(PredictCells, MovesCellsAndTheirInverseDepthToTheNextFrame) {
    CellMotion m{test::barrel(), {test::smallTurn(), {0.1F, 0.05F, -0.2F}}, 0.3F, 0.4F, 1.5F,
                 0.05F};
    const Size cells{100, 80};
    for (const std::size_t count : test::kLengths) {
        const Cells input(count);
        std::vector<std::int32_t> landing(count);
        Row moved(count);
        predictCells(m, input.raysX.data(), input.raysY.data(), input.s.data(), count, cells,
                     landing.data(), moved.data());
        for (std::size_t i = 0; i < count; ++i) {
            const double s = input.s[i], depth = 1 - s * m.lastZ;
            auto p = test::turned(m.motion.turn,
                                  {input.raysX[i] * depth, input.raysY[i] * depth, depth});
            p = {p.x + s * m.motion.move[0], p.y + s * m.motion.move[1],
                 p.z + s * m.motion.move[2]};
            const auto q = test::project(m.lens, p.x / p.z, p.y / p.z);
            if (test::isBetween(q.x) || test::isBetween(q.y)) continue;
            const double x = std::floor(q.x + 0.5), y = std::floor(q.y + 0.5);
            const bool inside = x >= 0 && y >= 0 && x < 100 && y < 80;
            ASSERT_EQ(landing[i], inside ? static_cast<int>(y * 100 + x) : -1);
            ASSERT_NEAR(moved[i], s / (p.z + s * m.nextZ) * m.perUnit, 1e-4);
        }
    }
}

}  // namespace
}  // namespace mfar::simd
