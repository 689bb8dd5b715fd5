#include "pipeline/engine/engine.h"
#include "pipeline/frame_matcher.h"
#include "pipeline/gles/subpixel_corrector.h"
#include "pipeline/simd/subpixel_flow.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/surfaces.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace mfar {
namespace {

constexpr Size kVideo = kSurfacesVideo;

/// Dark and bright patches with sharp borders.
double patchesAt(const Eigen::Vector2d& p) {
    return 128 + 110 * std::tanh((surfaceTexture(p) - 128) / 8);
}

std::vector<FlowCell> correctedOnHost(const Surfaces& in, bool usesErrors = true, float light = 0) {
    std::vector<FlowCell> out = in.given;
    simd::SubpixelFlow(in.rig, std::make_shared<Workers>(2))
        .run(in.video, in.pairs(), light, in.work, out.data(),
             usesErrors ? in.errors.data() : nullptr);
    return out;
}

std::vector<FlowCell> correctedOnGpu(const Surfaces& in, bool usesErrors = true, float light = 0) {
    const SurfacesOnGpu on(in, usesErrors);
    SubpixelCorrector(in.rig).run(on.cells, on.fields, in.videoTexture(), in.stillTexture(), light,
                                  on.tiles);
    return on.cells.read<FlowCell>(in.given.size(), 0);
}

/// Compares the corrected flow with the oracle's. `in`: with the chosen flow, see chosenOnHost().
/// Returns the number of cells whose flow changes by more than 0.02 px.
int expectTheOraclesFlow(const Surfaces& in, const std::vector<FlowCell>& got, bool usesErrors,
                         float light = 0) {
    const twin::SubpixelCase oracle = oracleOf(in, usesErrors, light);
    std::vector<Eigen::Matrix4d> scatter;
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x)
            scatter.push_back(oracle.compared[in.index(x, y)] &&
                                      twin::isShown(oracle, x, y, oracle.flow[in.index(x, y)])
                                  ? twin::scatterOf(oracle, x, y)
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

/// Compares the flow of both engines with the oracle's. At least `leastMoved` cells must move.
void expectTheOraclesFlow(const Surfaces& in, int leastMoved, bool usesErrors = true,
                          float light = 0) {
    EXPECT_GE(expectTheOraclesFlow(chosenOnHost(in, usesErrors, light),
                                   correctedOnHost(in, usesErrors, light), usesErrors, light),
              leastMoved);
    EXPECT_GE(expectTheOraclesFlow(chosenOnGpu(in, usesErrors, light),
                                   correctedOnGpu(in, usesErrors, light), usesErrors, light),
              leastMoved);
}

/// Number of cells that choose the flow of a neighbour. Without one, expectTheOraclesFlow() would
/// pass without the choice, too, because its reference starts from the engine's own choice.
int countChosen(const Surfaces& in, const Surfaces& chosen) {
    int count = 0;
    for (std::size_t i = 0; i < in.given.size(); ++i)
        count += chosen.given[i].x != in.given[i].x ? 1 : 0;
    return count;
}

using SubpixelEngines = GlTest;

TEST_F(SubpixelEngines, BothEnginesMatchTheOracle) {
    for (const bool usesErrors : {true, false}) {
        const Surfaces in;
        expectTheOraclesFlow(in, 400, usesErrors);
    }
}

TEST_F(SubpixelEngines, BothEnginesMatchTheOracleForTheChosenFlow) {
    Surfaces in;
    in.confuse();
    EXPECT_GT(countChosen(in, chosenOnHost(in)), 12);
    EXPECT_GT(countChosen(in, chosenOnGpu(in)), 12);
    expectTheOraclesFlow(in, 400);
}

TEST_F(SubpixelEngines, BothEnginesMatchTheOracleForPixelsThatAverageLight) {
    const Surfaces in(kVideo, patchesAt);
    const auto withoutLight = correctedOnHost(in);
    for (const float light : {0.7F, 1.5F}) {
        expectTheOraclesFlow(in, 400, true, light);
        const auto onHost = correctedOnHost(in, true, light);
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
        expectTheOraclesFlow(in, 0);
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

TEST_F(SubpixelEngines, TheFlowOfAnotherSurfaceIsReplacedFirst) {
    Surfaces in;
    in.confuse();
    for (ErrorCell& error : in.errors)
        error.error = 0;
    EXPECT_GT(meanError(in, in.given, kEdge, kEdge + 1), 1.5);
    EXPECT_LT(meanError(in, correctedOnHost(in), kEdge, kEdge + 1), 0.1);
    EXPECT_LT(meanError(in, correctedOnGpu(in), kEdge, kEdge + 1), 0.1);
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
                                      away > 4 ? 1e-6 : 0.3);
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
                const Eigen::Array2d seen =
                    twin::stillPixel(in.rig, p + surfaceFlow(p)).array() + 0.5;
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
