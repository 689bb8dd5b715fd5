#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"
#include "tests/oracle/enlarge.h"

#include <cmath>

namespace mfar {
namespace {

using PipelineTest = GlTest;

const Eigen::Vector2d kShift{2.3, -1.4};

int unchangedTiles(const Pipeline& p) {
    return p.readStats().tiles[static_cast<std::size_t>(TileClass::Unchanged)];
}
int tileCount(const Pipeline& p) {
    return static_cast<int>(p.readTileClasses().size());
}

TEST_F(PipelineTest, WithoutAStillTheVideoIsEnlarged) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setQuality({.learned = false});
    // Low contrast, so that no value leaves a byte's range when the video is enlarged along
    // columns: the shaders would clamp it, but the oracle does not.
    const TestPicture video = Waves(1, 1.2, 60, 25, 96).shoot(c.rig.video.size, {});
    const FrameResult& r = p.run(video.view(), {});
    EXPECT_FALSE(r.stats.usedStill);
    EXPECT_EQ(r.picture.size(), (Size{576, 432}));
    EXPECT_TRUE(p.readFlow().empty());
    EXPECT_TRUE(p.readConfidence().empty());
    const twin::Grey luma = twin::luma(video.view());
    for (const double value : twin::enlargedColumns(luma, p.outputSize().height).values)
        ASSERT_TRUE(value > 0 && value < 255);
    const twin::Grey wanted = twin::enlarged(luma, p.outputSize());
    // Tolerance: the shaders first enlarge along columns and round the result to 8 bits. The
    // kernels first enlarge along rows and round the result to 1/64 grey level.
    const double twiceRounded = 0.51 * (1 + twin::kCubicGain) * roundingFactor();
    const auto image = p.readImage();
    for (std::size_t i = 0; i < wanted.values.size(); ++i)
        ASSERT_NEAR(image[4 * i], std::clamp(wanted.values[i], 0.0, 255.0), twiceRounded) << i;
}

void expectGainByAStill(bool learned) {
    const PipelineCase c;
    const TestPicture video = c.video(kShift), still = c.still();
    Pipeline p(c.rig, {});
    p.setQuality({.learned = learned});
    const auto truth = c.fine(p.outputSize(), kShift).bytes;
    p.run(video.view(), {});
    const double enlarged = psnr(p.readImage(), truth);
    p.setStill(still.view(), {});
    p.run(video.view(), {});
    EXPECT_TRUE(p.readStats().usedStill);
    const double detail = psnr(p.readImage(), truth);
    EXPECT_GT(detail, enlarged + 2);
    p.setMode(SuperResMode::Blend);
    p.run(video.view(), {});
    EXPECT_GT(psnr(p.readImage(), truth), enlarged + 2);
    p.setMode(SuperResMode::Off);
    p.run(video.view(), {});
    if (learned)
        EXPECT_NE(psnr(p.readImage(), truth), enlarged);
    else
        EXPECT_DOUBLE_EQ(psnr(p.readImage(), truth), enlarged);
    p.setMode(SuperResMode::Detail);
    p.run(video.view(), {});
    // The search starts from the flow of the last frame; so the result may be slightly better.
    EXPECT_GT(psnr(p.readImage(), truth), detail - 0.1);
    EXPECT_LT(psnr(p.readImage(), truth), detail + 0.3);
    p.dropStill();
    p.run(video.view(), {});
    EXPECT_DOUBLE_EQ(psnr(p.readImage(), truth), enlarged);
}

TEST_F(PipelineTest, AStillBringsThePictureCloserToTheTruth) {
    expectGainByAStill(false);
}

TEST_F(PipelineTest, AStillBringsThePictureCloserToTheTruthThanFiltersDo) {
    expectGainByAStill(true);
}

TEST_F(PipelineTest, FlowAndConfidenceFollowTheMotion) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {});
    p.run(c.video(kShift).view(), {});
    const auto flow = p.readFlow(), confidence = p.readConfidence();
    double error = 0, sure = 0;
    int n = 0;
    for (int y = 16; y < 104; ++y)
        for (int x = 16; x < 144; ++x, ++n) {
            const std::size_t i = 160UL * y + x;
            error += std::hypot(flow[2 * i] - kShift.x(), flow[2 * i + 1] - kShift.y());
            sure += confidence[i];
        }
    EXPECT_LT(error / n, 0.15);
    EXPECT_GT(sure / n, 0.8);
    EXPECT_GT(p.readStats().meanConfidence, 0.7);
    EXPECT_GT(p.readStats().explained, 0.7);
}

TEST_F(PipelineTest, AnUnrelatedStillAddsNothing) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    const TestPicture video = Waves(9, 6, 60, 30).shoot(c.rig.video.size, {});
    p.run(video.view(), {});
    const auto enlarged = p.readImage();
    TestPicture noise = randomPicture(c.rig.still.size, 1);
    p.setStill(noise.view(), {});
    p.run(video.view(), {});
    EXPECT_GT(psnr(p.readImage(), enlarged), 35);
    EXPECT_LT(p.readStats().explained, 0.3);
}

TEST_F(PipelineTest, AnIdenticalFrameNeedsNoWorkAndChangesNothing) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {});
    const TestPicture video = c.video(kShift);
    p.run(video.view(), {});
    EXPECT_EQ(unchangedTiles(p), 0);
    const auto before = p.readImage();
    p.run(video.view(), {});
    EXPECT_EQ(unchangedTiles(p), tileCount(p));
    EXPECT_EQ(p.readStats().redrawn, 0);
    EXPECT_EQ(p.readImage(), before);
    p.setSkipUnchanged(false);
    p.run(video.view(), {});
    EXPECT_EQ(unchangedTiles(p), 0);
}

TEST_F(PipelineTest, OnlyTilesAroundAChangeAreDrawn) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {});
    TestPicture video = c.video(kShift);
    p.run(video.view(), {});
    const auto before = p.readImage();
    for (int y = 40; y < 56; ++y)
        for (int x = 72; x < 88; ++x)
            std::fill_n(video.at(x, y), 3, 255 - *video.at(x, y));
    p.run(video.view(), {});
    const auto after = p.readImage();
    const auto classes = p.readTileClasses();
    ASSERT_EQ(classes.size(), 80U);
    for (int ty = 0; ty < 8; ++ty)
        for (int tx = 0; tx < 10; ++tx) {
            const bool touched = tx >= 4 && tx <= 5 && ty >= 2 && ty <= 3;
            EXPECT_EQ(classes[10 * ty + tx] != TileClass::Unchanged, touched) << tx << ", " << ty;
        }
    int inside = 0;
    for (int y = 0; y < 432; ++y)
        for (int x = 0; x < 576; ++x) {
            const std::size_t i = 4UL * (576UL * y + x);
            const bool touched = x >= 230 && x < 346 && y >= 115 && y < 231;
            if (touched)
                inside += before[i] != after[i] ? 1 : 0;
            else
                ASSERT_EQ(before[i], after[i]) << x << ", " << y;
        }
    EXPECT_GT(inside, 2000);
}

TEST_F(PipelineTest, NoiseDoesNotMarkTilesChanged) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {});
    const TestPicture clean = Waves(3, 20, 90, 30).shoot(c.rig.video.size, {});
    int unchanged = 0;
    for (unsigned i = 0; i < 24; ++i) {
        TestPicture noisy = clean;
        addNoise(noisy, 2, i);
        p.run(noisy.view(), {});
        unchanged = unchangedTiles(p);
    }
    EXPECT_GE(unchanged, 0.95 * tileCount(p));
}

TEST_F(PipelineTest, TheSameInputsGiveTheSameOutput) {
    const PipelineCase c;
    const auto run = [&] {
        Pipeline p(c.rig, {});
        p.setStill(c.still().view(), {});
        p.run(c.video(kShift).view(), {});
        p.run(c.video({3, -1}).view(), {});
        return p.readImage();
    };
    EXPECT_EQ(run(), run());
}

TEST_F(PipelineTest, StagesAreTimedInOrder) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setMeasure(true);
    p.setStill(c.still().view(), {});
    p.run(c.video().view(), {});
    std::string stages;
    for (const StageTime& s : p.stageTimes()) {
        stages += std::string(s.stage) + " ";
        EXPECT_GE(s.ms, 0);
    }
    EXPECT_EQ(stages, "plan pyramid flow weigh detail ");
}

}  // namespace
}  // namespace mfar
