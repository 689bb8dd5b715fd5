#include "pipeline/flow/cell_field.h"
#include "pipeline/gles/direct_matcher.h"
#include "pipeline/simd/direct_match.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"
#include "tests/engine/seen_still.h"
#include "tests/oracle/direct.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mfar {
namespace {

constexpr Size kVideo{158, 94}, kStill{569, 338};
constexpr double kNoise = 1;

/// Lines of print that are closer together than two video pixels, on paper with some stains.
double printAt(const Eigen::Vector2d& still) {
    const double lines = std::sin(0.97 * still.y() + 0.02 * still.x());
    const double letters = std::sin(0.71 * still.x()) * std::sin(0.13 * still.x() + 2);
    return 128 + 70 * lines * (0.4 + 0.6 * letters) + 12 * std::sin(0.05 * still.x());
}

Eigen::Vector2d trueFlow(double x, double y) {
    return {2.3 + 0.012 * x - 0.006 * y, -1.6 - 0.004 * x + 0.02 * y};
}

/// A video of fine print that aliases. The flow along epipolar lines (`lines`) is correct except
/// for small errors and some outliers; most of the refined flow (`given`) has errors of up to 0.8
/// px along each axis. Some cells are not doubtful (see params::kGoodCost), and some tiles are not
/// matched.
struct Print : SeenStill {
    Print()
        : SeenStill(bentRig(kVideo, kStill), printAt,
                    [](const Eigen::Vector2d& p) { return trueFlow(p.x(), p.y()); }),
          work(TileWork::everything(tilesOf(kVideo))) {
        work.noise = kNoise;
        for (std::size_t i = 0; i < work.flags.size(); ++i)
            work.flags[i].matched = i % 7 != 3 ? 1 : 0;
        fillCells();
    }

    void fillCells() {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> error(-1, 1), share(0, 1);
        for (int y = 0; y < cells.height; ++y)
            for (int x = 0; x < cells.width; ++x) {
                const Eigen::Vector2f flow = trueFlow(4 * x + 1.5, 4 * y + 1.5).cast<float>();
                const float outlier = share(random) < 0.05F ? 7 : 0;
                lines.push_back({flow.x() + 0.1F * error(random) + outlier,
                                 flow.y() + 0.03F * error(random), 0, 0});
                const float off = share(random) < 0.3F ? 0 : 0.8F;
                given.push_back({flow.x() + off * error(random), flow.y() + off * error(random),
                                 share(random) < 0.2F ? 0.05F : 0.1F + 0.8F * share(random),
                                 share(random) < 0.1F ? 300.0F : 9000.0F});
                const float z = share(random);
                errors.push_back({z < 0.7F ? 0 : z < 0.95F ? 3 * share(random) : 1e4F});
            }
    }

    [[nodiscard]] twin::DirectCase oracle() const {
        twin::DirectCase out{rig, grey, still, cells, {}, kNoise};
        for (const auto& u : lines)
            out.lines.emplace_back(u[0], u[1]);
        return out;
    }

    const Size cells = cellsOf(kVideo);
    TileWork work;
    std::vector<std::array<float, 4>> lines;
    std::vector<FlowCell> given;
    std::vector<ErrorCell> errors;
};

struct Matched {
    std::vector<FlowCell> flow;
    std::vector<ErrorCell> errors;
};

Matched matchedOnHost(const Print& in) {
    const simd::StillPairs still = in.pairs();
    const simd::LookUpParams lookUp(in.rig);
    const simd::DirectMatch match{in.video,
                                  still,
                                  lookUp,
                                  in.cells,
                                  in.lines.data(),
                                  static_cast<float>(kNoise),
                                  params::kTexturePerVariance * 2};
    Matched out{in.given, in.errors};
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x)
            if (in.work.at(x / kCellsPerTile, y / kCellsPerTile).matched != 0)
                simd::matchDirectly(match, y, x, x + 1, out.flow.data(), out.errors.data());
    return out;
}

Matched matchedOnGpu(const Print& in) {
    const std::size_t count = in.given.size();
    gpu::Buffer cells(3 * count * sizeof(FlowCell));
    cells.write(std::span(in.given), 0);
    cells.write(std::span(in.lines), count * sizeof(FlowCell));
    cells.write(std::span(in.errors), 2 * count * sizeof(FlowCell));
    TileBuffer tiles(kVideo);
    tiles.set(in.work);
    DirectMatcher(in.rig).run(cells, {0, static_cast<int>(count), 2 * static_cast<int>(count)},
                              in.videoTexture(), in.stillTexture(), tiles);
    return {cells.read<FlowCell>(count, 0),
            cells.read<ErrorCell>(count, 2 * count * sizeof(FlowCell))};
}

twin::DirectResult wantedOf(const Print& in, const twin::DirectCase& oracle, int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y) * in.cells.width + x;
    const FlowCell& given = in.given[i];
    if (in.work.at(x / kCellsPerTile, y / kCellsPerTile).matched != 0)
        return twin::matchDirectly(oracle, x, y, given, in.errors[i].error);
    return {{given.x, given.y}, Eigen::Vector4d::Zero(), in.errors[i].error, false, 1};
}

/// Compares the results with the oracle's. The oracle maps every sample through both lenses. The
/// engines map only the patch's centre, and use derivatives around it. So where the flow along the
/// line and the given flow fit almost equally well, the oracle and an engine may choose
/// differently. Such cells are not compared.
void expectTheOraclesMatches(const Print& in, const Matched& got) {
    const twin::DirectCase oracle = in.oracle();
    int moved = 0, compared = 0, untouched = 0;
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * in.cells.width + x;
            const FlowCell& flow = got.flow[i];
            const ErrorCell& error = got.errors[i];
            const twin::DirectResult want = wantedOf(in, oracle, x, y);
            EXPECT_EQ(flow.cost, in.given[i].cost);
            EXPECT_EQ(flow.texture, in.given[i].texture);
            if (want.choiceMargin < 0.03) continue;
            ASSERT_NEAR(flow.x, want.flow.x(), 2e-3) << x << ", " << y;
            ASSERT_NEAR(flow.y, want.flow.y(), 2e-3) << x << ", " << y;
            const double known = std::pow(1.0 - in.given[i].cost, 2);
            if (want.likeness[3] > 0 && std::abs(want.likeness[3] - known) < 0.03) continue;
            ASSERT_EQ(error.varianceVideo > 0, want.compared) << x << ", " << y;
            ASSERT_NEAR(error.error, want.error, 0.06 * (1 + want.error)) << x << ", " << y;
            moved += (want.flow - Eigen::Vector2d(in.given[i].x, in.given[i].y)).norm() > 0 ? 1 : 0;
            compared += want.compared ? 1 : 0;
            untouched += want.likeness[3] == 0 ? 1 : 0;
            if (!want.compared) continue;
            ASSERT_NEAR(error.covariance, want.likeness[0], 0.06 * want.likeness[1] + 100);
            ASSERT_NEAR(error.varianceVideo, want.likeness[1], 0.01 * want.likeness[1] + 50);
            ASSERT_NEAR(error.varianceStill, want.likeness[2], 0.06 * want.likeness[2] + 100);
        }
    EXPECT_GT(moved, 100);
    EXPECT_GT(compared, 300);
    EXPECT_GT(untouched, 100);
}

using DirectEngines = GlTest;

TEST_F(DirectEngines, SimdComparisonWithTheStillMatchesTheOracle) {
    const Print in;
    expectTheOraclesMatches(in, matchedOnHost(in));
}

TEST_F(DirectEngines, GlesComparisonWithTheStillMatchesTheOracle) {
    const Print in;
    expectTheOraclesMatches(in, matchedOnGpu(in));
}

// The reduced still cannot show which flow is right, because the print aliases.
TEST_F(DirectEngines, FinePrintGetsTheFlowAlongEpipolarLinesAndAHigherCorrelation) {
    const Print in;
    const Matched got = matchedOnHost(in);
    int right = 0, doubtful = 0;
    for (int y = 2; y < in.cells.height - 2; ++y)
        for (int x = 2; x < in.cells.width - 2; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * in.cells.width + x;
            const ErrorCell& error = got.errors[i];
            if (!(error.covariance > 0)) continue;
            const Eigen::Vector2d off =
                Eigen::Vector2d(got.flow[i].x, got.flow[i].y) - trueFlow(4 * x + 1.5, 4 * y + 1.5);
            ++doubtful;
            right += std::abs(off.y()) < 0.15 ? 1 : 0;
            EXPECT_GT(std::pow(error.covariance, 2) / (error.varianceVideo * error.varianceStill),
                      std::pow(1 - in.given[i].cost, 2));
        }
    EXPECT_GT(doubtful, 300);
    EXPECT_GT(right, 0.9 * doubtful);
}

TEST_F(DirectEngines, ACellWithoutAValidFlowStaysAsItIs) {
    Print in;
    const float nan = std::nanf("");
    for (FlowCell& cell : in.given)
        cell.x = nan;
    for (auto& line : in.lines)
        line = {nan, nan, 0, 0};
    for (const Matched& got : {matchedOnHost(in), matchedOnGpu(in)})
        for (std::size_t i = 0; i < in.given.size(); ++i) {
            EXPECT_TRUE(std::isnan(got.flow[i].x));
            EXPECT_EQ(got.errors[i].covariance, 0);
            EXPECT_EQ(got.errors[i].error, in.errors[i].error);
        }
}

}  // namespace
}  // namespace mfar
