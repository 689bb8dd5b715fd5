#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"

namespace mfar {
namespace {

class FrameStatsTest : public GlTest, public testing::WithParamInterface<EngineKind> {
protected:
    [[nodiscard]] Pipeline pipeline() const {
        return Pipeline(case_.rig, {.output = {}, .engines = EngineChoice::all(GetParam())});
    }

    PipelineCase case_;
};
INSTANTIATE_TEST_SUITE_P(Engines, FrameStatsTest,
                         testing::Values(EngineKind::Simd, EngineKind::Gles),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST_P(FrameStatsTest, ARedrawDoesNotCountAsAChangeOfTheVideo) {
    Pipeline p = pipeline();
    const TestPicture frame = case_.video();
    const auto expectAtRest = [&](double redrawn, const char* what) {
        const FrameStats stats = p.run(frame.view(), {}).stats;
        EXPECT_EQ(stats.changed, 0) << what;
        EXPECT_EQ(stats.redrawn, redrawn) << what;
    };
    EXPECT_EQ(p.run(frame.view(), {}).stats.changed, 1) << "the first frame";
    expectAtRest(0, "the same frame again");
    p.setStill(case_.still().view(), {});
    expectAtRest(1, "a new still");
    p.redraw();
    expectAtRest(1, "a redraw");
    p.setSkipUnchanged(false);
    expectAtRest(1, "every frame is drawn");
    EXPECT_GT(p.run(case_.video({3, 0}).view(), {}).stats.changed, 0.9) << "a moved frame";
}

/// Lowers the contrast from right to left, so that the tiles have different amounts of structure.
TestPicture faded(TestPicture picture) {
    const Size size = picture.size;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int i = 0; i < 3; ++i) {
                const double contrast = 0.2 + 0.8 * x / size.width;
                std::uint8_t& value = picture.at(x, y)[i];
                value = static_cast<std::uint8_t>(128 + contrast * (value - 128));
            }
    return picture;
}

TEST_P(FrameStatsTest, TilesThatAreNotMatchedAreAssumedToBeExplainedAsOftenAsTheOthers) {
    const TestPicture frame = faded(case_.video({2, 0}));
    for (const bool fits : {false, true}) {
        Pipeline p = pipeline();
        const TestPicture still =
            fits ? faded(case_.still()) : randomPicture(case_.rig.still.size, 1);
        p.setStill(still.view(), {});
        for (const double share : {1.0, 0.3}) {
            p.setQuality({.detailShare = share});
            p.redraw();
            p.run(frame.view(), {});
            const double explained = p.readStats().explained;
            EXPECT_EQ(explained > 0.7, fits) << share << ": " << explained;
            EXPECT_EQ(explained < 0.3, !fits) << share << ": " << explained;
        }
    }
}

}  // namespace
}  // namespace mfar
