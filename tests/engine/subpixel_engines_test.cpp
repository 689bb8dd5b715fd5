#include "pipeline/engine/engine.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/frame_matcher.h"
#include "pipeline/gles/subpixel_corrector.h"
#include "pipeline/simd/subpixel_flow.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"
#include "tests/engine/seen_still.h"
#include "tests/oracle/subpixel.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace mfar {
namespace {

constexpr Size kVideo{158, 94};
constexpr double kNoise = 1;

/// Size of a still with 3.6 pixels per video pixel along each axis.
Size stillOf(Size video) {
    return {video.width * 18 / 5, video.height * 18 / 5};
}

/// Waves in several directions. Their lengths are 1.7 to 65 video pixels.
double textureAt(const Eigen::Vector2d& p) {
    double sum = 128;
    for (int k = 0; k < 10; ++k) {
        const double angle = 0.9 * k, wave = 0.027 * std::pow(1.5, k);
        sum += 11 * std::sin(wave * (std::cos(angle) * p.x() + std::sin(angle) * p.y()) + k);
    }
    return sum;
}

/// Dark and bright patches with sharp borders.
double patchesAt(const Eigen::Vector2d& p) {
    return 128 + 110 * std::tanh((textureAt(p) - 128) / 8);
}

/// Column of cells at which another surface begins, with a step of the flow of 3 px.
constexpr int kEdge = 22;

Eigen::Vector2d trueFlow(const Eigen::Vector2d& p) {
    const double step = p.x() >= kCell * kEdge - 0.5 ? 3 : 0;
    return {2.3 + 0.012 * p.x() - 0.006 * p.y() + step, -1.6 - 0.004 * p.x() + 0.02 * p.y()};
}

Eigen::Vector2d middleOf(int x, int y) {
    return {kCell * x + 1.5, kCell * y + 1.5};
}

/// Two surfaces, and a given flow with errors of 0.15 px (standard deviation along each axis). Some
/// tiles are not matched, and some cells are not shown in the still. `light`: see SeenStill.
struct Surfaces : SeenStill {
    explicit Surfaces(Size video = kVideo, decltype(&textureAt) texture = textureAt,
                      double light = 0)
        : SeenStill(bentRig(video, stillOf(video)), texture, trueFlow, light),
          cells(cellsOf(video)), work(TileWork::everything(tilesOf(video))) {
        work.noise = kNoise;
        for (std::size_t i = 0; i < work.flags.size(); ++i)
            work.flags[i].matched = i % 11 != 3 ? 1 : 0;
        std::mt19937 random(1);
        std::normal_distribution<float> error(0, 0.15F);
        for (int y = 0; y < cells.height; ++y)
            for (int x = 0; x < cells.width; ++x) {
                const Eigen::Vector2f flow = trueFlow(middleOf(x, y)).cast<float>();
                given.push_back({flow.x() + error(random), flow.y() + error(random), 0.1F, 9000});
                errors.push_back({random() % 16 == 0 ? 1e4F : 0});
            }
    }

    [[nodiscard]] bool isMatched(int x, int y) const {
        return work.at(x / kCellsPerTile, y / kCellsPerTile).matched != 0;
    }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * cells.width + x;
    }
    [[nodiscard]] double errorOf(const FlowCell& cell, int x, int y) const {
        return (Eigen::Vector2d(cell.x, cell.y) - trueFlow(middleOf(x, y))).norm();
    }

    const Size cells;
    TileWork work;
    std::vector<FlowCell> given;
    std::vector<ErrorCell> errors;
};

std::vector<FlowCell> correctedOnHost(const Surfaces& in, bool usesErrors = true, float light = 0) {
    std::vector<FlowCell> out = in.given;
    simd::SubpixelFlow(in.rig, std::make_shared<Workers>(2))
        .run(in.video, in.pairs(), light, in.work, out.data(),
             usesErrors ? in.errors.data() : nullptr);
    return out;
}

std::vector<FlowCell> correctedOnGpu(const Surfaces& in, bool usesErrors = true, float light = 0) {
    const std::size_t count = in.given.size();
    gpu::Buffer cells(2 * count * sizeof(FlowCell));
    cells.write(std::span(in.given), 0);
    cells.write(std::span(in.errors), count * sizeof(FlowCell));
    TileBuffer tiles(in.rig.video.size);
    tiles.set(in.work);
    SubpixelCorrector(in.rig).run(cells, {0, usesErrors ? static_cast<int>(count) : -1},
                                  in.videoTexture(), in.stillTexture(), light, tiles);
    return cells.read<FlowCell>(count, 0);
}

twin::SubpixelCase oracleOf(const Surfaces& in, bool usesErrors, float light) {
    twin::SubpixelCase out{in.rig, in.grey, in.still, in.cells, {}, {}, kNoise, light};
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x) {
            const std::size_t i = in.index(x, y);
            const Eigen::Vector2d flow(in.given[i].x, in.given[i].y),
                at = twin::stillPixel(in.rig, middleOf(x, y) + flow);
            const Size still = in.rig.still.size, video = in.rig.video.size;
            const bool isInside =
                at.minCoeff() >= 0 && at.x() <= still.width - 1 && at.y() <= still.height - 1;
            const bool isWhole = kCell * (x + 1) <= video.width && kCell * (y + 1) <= video.height;
            out.flow.push_back(flow);
            out.compared.push_back(in.isMatched(x, y) && isWhole && isInside &&
                                   (!usesErrors || in.errors[i].error < params::kNotShown));
        }
    return out;
}

/// Compares the corrected flow with the oracle's. Returns the number of cells whose flow changes by
/// more than 0.02 px.
int expectTheOraclesFlow(const Surfaces& in, const std::vector<FlowCell>& got, bool usesErrors,
                         float light = 0) {
    const twin::SubpixelCase oracle = oracleOf(in, usesErrors, light);
    std::vector<Eigen::Matrix4d> scatter;
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x)
            scatter.push_back(oracle.compared[in.index(x, y)] ? twin::scatterOf(oracle, x, y)
                                                              : Eigen::Matrix4d::Zero());
    int moved = 0;
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x) {
            const std::size_t i = in.index(x, y);
            EXPECT_EQ(got[i].cost, in.given[i].cost);
            EXPECT_EQ(got[i].texture, in.given[i].texture);
            const twin::SubpixelStep want = twin::stepOf(oracle, scatter, x, y);
            if (std::abs(want.step.norm() - params::kSubpixelLongest) < 0.05 ||
                std::abs(want.gain - params::kLeastSubpixelGain) < 0.02)
                continue;
            const Eigen::Vector2d step =
                in.isMatched(x, y) ? want.taken() : Eigen::Vector2d::Zero();
            moved += step.norm() > 0.02 ? 1 : 0;
            EXPECT_NEAR(got[i].x - in.given[i].x, step.x(), 3e-3) << x << ", " << y;
            EXPECT_NEAR(got[i].y - in.given[i].y, step.y(), 3e-3) << x << ", " << y;
        }
    return moved;
}

using SubpixelEngines = GlTest;

TEST_F(SubpixelEngines, BothEnginesMatchTheOracle) {
    for (const bool usesErrors : {true, false}) {
        const Surfaces in;
        EXPECT_GT(expectTheOraclesFlow(in, correctedOnHost(in, usesErrors), usesErrors), 400);
        EXPECT_GT(expectTheOraclesFlow(in, correctedOnGpu(in, usesErrors), usesErrors), 400);
    }
}

TEST_F(SubpixelEngines, BothEnginesMatchTheOracleForPixelsThatAverageLight) {
    const Surfaces in(kVideo, patchesAt);
    const auto withoutLight = correctedOnHost(in);
    for (const float light : {0.7F, 1.5F}) {
        const auto onHost = correctedOnHost(in, true, light);
        EXPECT_GT(expectTheOraclesFlow(in, onHost, true, light), 400);
        EXPECT_GT(expectTheOraclesFlow(in, correctedOnGpu(in, true, light), true, light), 400);
        double most = 0;
        for (std::size_t i = 0; i < onHost.size(); ++i)
            most = std::max<double>(most, std::abs(onHost[i].x - withoutLight[i].x));
        EXPECT_GT(most, 0.05) << "the way in which pixels average light must change the flow";
    }
}

TEST_F(SubpixelEngines, BothEnginesMatchTheOracleInPicturesOfAnySize) {
    for (const Size video : {Size{16, 16}, {17, 19}, {61, 45}, {256, 64}}) {
        SCOPED_TRACE(video.width);
        const Surfaces in(video);
        expectTheOraclesFlow(in, correctedOnHost(in), true);
        expectTheOraclesFlow(in, correctedOnGpu(in), true);
    }
}

/// Errors [px] of the matched cells in the columns [first, end), without the first and last row.
std::vector<double> errorsOf(const Surfaces& in, const std::vector<FlowCell>& flow, int first,
                             int end) {
    std::vector<double> out;
    for (int y = 1; y < in.cells.height - 1; ++y)
        for (int x = first; x < end; ++x)
            if (in.isMatched(x, y)) out.push_back(in.errorOf(flow[in.index(x, y)], x, y));
    return out;
}

double meanError(const Surfaces& in, const std::vector<FlowCell>& flow, int first, int end) {
    const std::vector<double> all = errorsOf(in, flow, first, end);
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

double medianError(const Surfaces& in, const std::vector<FlowCell>& flow, int first, int end) {
    return medianOf(errorsOf(in, flow, first, end));
}

TEST_F(SubpixelEngines, ErrorsOfTheFlowShrink) {
    const Surfaces in;
    const std::vector<FlowCell> got = correctedOnHost(in);
    EXPECT_GT(meanError(in, in.given, 1, in.cells.width - 1), 0.15);
    EXPECT_LT(meanError(in, got, 1, kEdge - 1), 0.05);
}

TEST_F(SubpixelEngines, ErrorsAtTheBorderShrink) {
    const Surfaces in;
    const std::vector<FlowCell> got = correctedOnHost(in);
    EXPECT_LT(meanError(in, got, 0, 1), 0.5 * meanError(in, in.given, 0, 1));
}

TEST_F(SubpixelEngines, NeighboursOnAnotherSurfaceDoNotCount) {
    const Surfaces in;
    const std::vector<FlowCell> got = correctedOnHost(in);
    EXPECT_LT(meanError(in, got, kEdge - 1, kEdge + 1), 0.07);
}

TEST_F(SubpixelEngines, AnInvalidFlowStaysAndDoesNotSpread) {
    Surfaces in;
    constexpr int kX = 10, kY = 8;
    ASSERT_TRUE(in.isMatched(kX, kY));
    const FlowCell sound = in.given[in.index(kX, kY)];
    const std::vector<FlowCell> before[] = {correctedOnHost(in), correctedOnGpu(in)};
    for (const float wrong : {std::nanf(""), 3e38F})
        for (float FlowCell::* axis : {&FlowCell::x, &FlowCell::y}) {
            FlowCell& hit = in.given[in.index(kX, kY)];
            hit = sound;
            hit.*axis = wrong;
            const std::vector<FlowCell> after[] = {correctedOnHost(in), correctedOnGpu(in)};
            for (int engine = 0; engine < 2; ++engine)
                for (int y = 0; y < in.cells.height; ++y)
                    for (int x = 0; x < in.cells.width; ++x) {
                        const FlowCell &was = before[engine][in.index(x, y)],
                                       &is = after[engine][in.index(x, y)];
                        const int away = std::max(std::abs(x - kX), std::abs(y - kY));
                        if (away == 0)
                            EXPECT_TRUE(std::isnan(wrong) ? std::isnan(is.*axis)
                                                          : is.*axis == wrong);
                        else
                            EXPECT_LT(std::hypot(is.x - was.x, is.y - was.y),
                                      away > 3 ? 1e-6 : 0.3);
                    }
        }
}

/// A flow step, and its input from one frame.
struct FlowOfOneFrame {
    FlowOfOneFrame(std::unique_ptr<Engine> made, const SeenStill& in, float ofLight = 0)
        : engine(std::move(made)), still(engine->still()), pyramid(engine->pyramid()),
          flow(engine->flow()), light(ofLight), view(in.videoView()), frame{view, in.video, 1},
          pictures(still->run(in.stillView(), SuperResMode::Detail, {}, 0)),
          luma(lumaOf(TileWork::everything(tilesOf(in.rig.video.size)))) {}

    const LumaPyramid& lumaOf(const TileWork& work) {
        pyramid->still(pictures, light);
        return pyramid->video(frame, work);
    }
    std::vector<FlowCell> run(const TileWork& work) {
        const FlowCells& cells = flow->run({frame, pictures, light}, luma, work, false);
        const FlowCell* first = cells.cells.host().data;
        return {first, first + cells.count()};
    }

    std::unique_ptr<Engine> engine;
    std::unique_ptr<StillStep> still;
    std::unique_ptr<PyramidStep> pyramid;
    std::unique_ptr<FlowStep> flow;
    float light;
    ImageView view;
    VideoFrame frame;
    const StillPictures& pictures;
    const LumaPyramid& luma;
};

TEST_F(SubpixelEngines, TheFlowStepsOfBothEnginesCorrectTheirFlow) {
    const Surfaces in;
    const StepSetup setup{in.rig, in.rig.still.size, {}, std::make_shared<Workers>(2), nullptr};
    TileWork work = TileWork::everything(tilesOf(kVideo));
    for (const bool gles : {true, false}) {
        FlowOfOneFrame step(gles ? makeGlesEngine(setup) : makeSimdEngine(setup), in);
        const std::vector<FlowCell> got = step.run(work);
        EXPECT_LT(medianError(in, got, 2, kEdge - 2), 0.015);
        // Without a matched tile, the flow of the last frame stays valid.
        TileWork none = work;
        none.matched = 0;
        const std::vector<FlowCell> later = step.run(none);
        for (std::size_t i = 0; i < got.size(); ++i)
            ASSERT_EQ(later[i].x, got[i].x) << gles << ", " << i;
    }
}

TEST_F(SubpixelEngines, FlowIsMoreExactIfItIsKnownHowPixelsAverageLight) {
    const Surfaces in(kVideo, patchesAt, 1);
    const StepSetup setup{in.rig, in.rig.still.size, {}, std::make_shared<Workers>(2), nullptr};
    const TileWork work = TileWork::everything(tilesOf(kVideo));
    for (const bool gles : {true, false}) {
        const auto error = [&](float light) {
            FlowOfOneFrame step(gles ? makeGlesEngine(setup) : makeSimdEngine(setup), in, light);
            return medianError(in, step.run(work), 2, kEdge - 2);
        };
        EXPECT_LT(error(1), 0.8 * error(0));
    }
}

TEST_F(SubpixelEngines, TheFrameMatcherIsMoreExactIfItIsKnownHowPixelsAverageLight) {
    const Surfaces in(kVideo, patchesAt, 1);
    FrameMatcher matcher(in.rig);
    const ImageView still = in.stillView();
    const auto error = [&](float light) {
        MatchedPictures found;
        matcher.match(in.video, {still.data, in.rig.still.size.width, still.size}, light, found);
        const Eigen::Array2d scale(found.scaleX, found.scaleY);
        std::vector<double> errors;
        for (int y = 1; y < in.cells.height - 1; ++y)
            for (int x = 2; x < kEdge - 2; ++x) {
                const Eigen::Vector2d p = middleOf(x, y);
                const Eigen::Array2d seen = twin::stillPixel(in.rig, p + trueFlow(p)).array() + 0.5;
                const LookUpCell& cell = found.lookUps[y][x];
                const Eigen::Array2d read =
                    (p.array() + 0.5) * scale + Eigen::Array2d(cell.x, cell.y);
                errors.push_back(((seen - read) / scale).matrix().norm());
            }
        return medianOf(errors);
    };
    EXPECT_LT(error(1), 0.8 * error(0));
}

}  // namespace
}  // namespace mfar
