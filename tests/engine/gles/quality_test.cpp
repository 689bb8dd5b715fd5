#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"
#include "tests/oracle/enlarge.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace mfar {
namespace {

using QualityTest = GlTest;
using Image = std::vector<std::uint8_t>;

Pose posed(double x) {
    Pose pose;
    pose.T_world_video.translation = {x, 0, 0};
    return pose;
}

Quality quick() {
    return {.mode = SuperResMode::Blend,
            .flow2d = {.searchRadius = 4, .candidates = 1, .steps = 1, .planeFits = 0},
            .epipolar = {.windowRadius = 1, .finest = 1, .mostPredicted = 1}};
}

PipelineOptions madeWith(const Quality& quality) {
    PipelineOptions out;
    out.mode = quality.mode;
    out.flow2d = quality.flow2d;
    out.epipolar = quality.epipolar;
    return out;
}

Image pictureOf(Pipeline& p, const PipelineCase& c, bool withPoses) {
    const auto pose = [&](double x) { return withPoses ? std::optional(posed(x)) : std::nullopt; };
    p.setStill(c.still().view(), {}, pose(0));
    p.run(c.video({2, 0}).view(), {}, pose(0.02));
    p.run(c.video({3, 0}).view(), {}, pose(0.03));
    return p.readImage();
}

TEST_F(QualityTest, IfTheStillIsNotUsedAFrameMayBeEnlargedLinearly) {
    const PipelineCase c;
    Pipeline p(c.rig, {}), cubic(c.rig, {}), detail(c.rig, {});
    p.setQuality({.mode = SuperResMode::Off, .cubic = false});
    cubic.setQuality({.mode = SuperResMode::Off});
    detail.setQuality({.cubic = false});
    TestPicture frame = c.video({2, 0});
    for (const bool inTiles : {false, true}) {
        for (int x = 50; inTiles && x < 54; ++x)
            std::fill_n(frame.at(x, 40), 3, static_cast<std::uint8_t>(60 * (x - 50)));
        for (Pipeline* each : {&p, &cubic})
            each->run(frame.view(), {});
        EXPECT_EQ(p.readStats().redrawn < 1, inTiles);
        const Image image = p.readImage();
        EXPECT_FALSE(image == cubic.readImage());
        const twin::Grey red = twin::greyOf(
            c.rig.video.size, [&](int x, int y) { return static_cast<double>(frame.at(x, y)[0]); });
        const twin::Grey wanted = twin::enlarged(red, p.outputSize(), true);
        for (std::size_t i = 0; i < wanted.values.size(); ++i)
            ASSERT_NEAR(image[4 * i], wanted.values[i], 1.02 * roundingFactor()) << i;
    }
    Pipeline usual(c.rig, {});
    EXPECT_TRUE(pictureOf(detail, c, false) == pictureOf(usual, c, false))
        << "the option cubic must have no effect on a frame with a still";
}

// Only the two lowest pixel rows of a tile change. They are also read to enlarge the tile below.
TEST_F(QualityTest, NeighboursAffectedByAChangeAreRedrawn) {
    const PipelineCase c;
    Pipeline p(c.rig, {}), whole(c.rig, {});
    TestPicture frame = c.video({2, 0});
    for (Pipeline* each : {&p, &whole})
        each->run(frame.view(), {});
    for (int x = 32; x < 48; ++x)
        for (int y = 46; y < 48; ++y)
            for (int channel = 0; channel < 3; ++channel)
                frame.at(x, y)[channel] = static_cast<std::uint8_t>(255 - frame.at(x, y)[channel]);
    whole.redraw();
    for (Pipeline* each : {&p, &whole})
        each->run(frame.view(), {});
    EXPECT_GE(p.readStats().tiles[0], 70);
    EXPECT_TRUE(p.readImage() == whole.readImage());
}

// Without learned filters, the video is enlarged along columns into a texture, and then along rows.
// Learned filters do not update this texture. A tile also reads the columns of its neighbours, so
// the first frame after learned filters must compute all columns.
TEST_F(QualityTest, ATileDrawnAfterLearnedFiltersReadsNoOldColumns) {
    const PipelineCase c;
    for (const bool cubic : {true, false}) {
        Pipeline p(c.rig, {}), whole(c.rig, {});
        p.run(c.video({2, 0}).view(), {});
        TestPicture frame = c.video({2, 0});
        constexpr PixelRect kTile{32, 32, 48, 48};
        for (int x = kTile.x0 + 4; x < kTile.x1 - 4; ++x)
            std::fill_n(frame.at(x, 40), 3, static_cast<std::uint8_t>(5 * x));
        for (Pipeline* each : {&p, &whole}) {
            each->setQuality({.mode = SuperResMode::Off, .cubic = cubic});
            each->run(frame.view(), {});
        }
        ASSERT_LT(p.readStats().redrawn, 0.2);
        const Image a = p.readImage(), b = whole.readImage();
        const Size output = p.outputSize();
        const double scale = static_cast<double>(output.width) / c.rig.video.size.width;
        for (int y = std::lround(kTile.y0 * scale); y < std::lround(kTile.y1 * scale); ++y) {
            const std::size_t row = 4UL * y * output.width;
            const auto first = static_cast<std::ptrdiff_t>(row + 4 * std::lround(kTile.x0 * scale)),
                       last = static_cast<std::ptrdiff_t>(row + 4 * std::lround(kTile.x1 * scale));
            ASSERT_TRUE(std::equal(a.begin() + first, a.begin() + last, b.begin() + first)) << y;
        }
    }
}

/// Without poses, both pictures must be equal. With poses, the search along epipolar lines starts
/// from the last frame's flow. Another start may change the flow of doubtful cells a little.
void expectAlike(const Image& a, const Image& b, bool withPoses) {
    ASSERT_EQ(a.size(), b.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        differing += a[i] != b[i] ? 1 : 0;
        ASSERT_NEAR(a[i], b[i], 4) << i;
    }
    EXPECT_LE(differing, withPoses ? a.size() / 500 : 0);
}

// All pipelines have processed the same frames before, so that they have measured the same noise.
TEST_F(QualityTest, SettingsChangedBetweenFramesActLikeInitialSettings) {
    const PipelineCase c;
    for (const bool withPoses : {false, true}) {
        Pipeline made(c.rig, madeWith(quick())), usual(c.rig, {}), changed(c.rig, {});
        for (Pipeline* p : {&made, &usual, &changed})
            (void)pictureOf(*p, c, withPoses);
        const Image wanted = pictureOf(made, c, withPoses);
        const Image sharp = pictureOf(usual, c, withPoses);
        changed.setQuality(quick());
        EXPECT_TRUE(pictureOf(changed, c, withPoses) == wanted) << withPoses;
        EXPECT_TRUE(wanted != sharp) << withPoses;
        changed.setQuality({});
        expectAlike(pictureOf(changed, c, withPoses), pictureOf(usual, c, withPoses), withPoses);
    }
}

TEST_F(QualityTest, PosesAreIgnoredIfTheOptionAlongLinesIsOff) {
    const PipelineCase c;
    Pipeline blind(c.rig, {}), posed(c.rig, {});
    posed.setQuality({.alongLines = false});
    EXPECT_TRUE(pictureOf(posed, c, true) == pictureOf(blind, c, false));
    EXPECT_FALSE(posed.readStats().usedPose);
}

TEST_F(QualityTest, PosesInAnotherWorldFrameThanTheStillsAreIgnored) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {}, posed(0));
    Pose other = posed(0.02);
    other.world = 1;
    EXPECT_FALSE(p.run(c.video({2, 0}).view(), {}, other).stats.usedPose);
    EXPECT_TRUE(p.run(c.video({3, 0}).view(), {}, posed(0.03)).stats.usedPose);
}

TEST_F(QualityTest, ARestingFrameDoesNotRepeatTheResultsOfAnEarlierSearch) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setStill(c.still().view(), {}, posed(0));
    const TestPicture frame = c.video({2, 0});
    EXPECT_GT(p.run(frame.view(), {}, posed(0.02)).stats.posePatches, 0);
    const FrameStats& rests = p.run(frame.view(), {}, posed(0.02)).stats;
    EXPECT_TRUE(rests.usedPose);
    EXPECT_EQ(rests.posePatches, 0);
    EXPECT_EQ(rests.epipolarError, 0);
}

TEST_F(QualityTest, UnchangedTilesKeepTheirPixels) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    const Image sharp = pictureOf(p, c, false);
    p.setQuality({.mode = SuperResMode::Off});
    p.run(c.video({3, 0}).view(), {});
    EXPECT_TRUE(p.readImage() == sharp);
    p.redraw();
    p.run(c.video({3, 0}).view(), {});
    EXPECT_TRUE(p.readImage() != sharp);
    EXPECT_EQ(p.readStats().redrawn, 1);
    p.setQuality({});
    p.redraw();
    p.run(c.video({3, 0}).view(), {});
    EXPECT_TRUE(p.readStats().usedStill);
}

TEST_F(QualityTest, SettingsOutOfRangeAreRefusedAndChangeNothing) {
    const PipelineCase c;
    Pipeline p(c.rig, {}), untouched(c.rig, {});
    EXPECT_TRUE(pictureOf(p, c, true) == pictureOf(untouched, c, true));
    for (const Quality& wrong :
         {Quality{.flow2d = {.steps = 17}}, Quality{.epipolar = {.finest = 3}},
          Quality{.detailShare = 0}, Quality{.detailShare = 1.01},
          Quality{.detailShare = std::numeric_limits<double>::quiet_NaN()},
          Quality{.secondShare = -0.01}, Quality{.secondShare = 1.01},
          Quality{.secondShare = std::numeric_limits<double>::quiet_NaN()},
          Quality{.depthEvery = 0}, Quality{.depthEvery = std::numeric_limits<int>::max()},
          Quality{.mode = SuperResMode::Off, .epipolar = {.windowRadius = -1}}})
        EXPECT_THROW(p.setQuality(wrong), std::invalid_argument);
    EXPECT_TRUE(pictureOf(p, c, true) == pictureOf(untouched, c, true));
}

TEST_F(QualityTest, OnlyTheConfiguredShareOfTilesGetsDetail) {
    const PipelineCase c;
    std::size_t before = 0;
    for (const double share : {0.3, 1.0}) {
        Pipeline p(c.rig, {});
        p.setQuality({.detailShare = share});
        (void)pictureOf(p, c, true);
        const std::vector<TileClass> classes = p.readTileClasses();
        const auto detailed = static_cast<std::size_t>(
            classes.size() - std::ranges::count(classes, TileClass::Enlarged));
        EXPECT_LE(static_cast<double>(detailed), share * static_cast<double>(classes.size()) + 1);
        EXPECT_GT(detailed, before);
        before = detailed;
    }
}

int mostDifference(const Image& a, const Image& b) {
    int out = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        out = std::max(out, std::abs(a[i] - b[i]));
    return out;
}

TEST_F(QualityTest, ThePictureIsTheSameIfNoWorkIsSkipped) {
    const PipelineCase c;
    Pipeline usual(c.rig, {});
    const Image wanted = pictureOf(usual, c, false);
    for (bool SkipOptions::* skip : {&SkipOptions::enlargedTiles, &SkipOptions::smoothTiles,
                                     &SkipOptions::plainTiles, &SkipOptions::tileLists}) {
        PipelineOptions options;
        options.skips.*skip = false;
        Pipeline p(c.rig, options);
        EXPECT_LE(mostDifference(pictureOf(p, c, false), wanted), 3);
    }
}

TestPicture evenButForAPatch(TestPicture picture, int grey) {
    const Size size = picture.view().size;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (5 * x < size.width || 2 * x > size.width || 3 * y < size.height ||
                4 * y > 3 * size.height)
                std::fill_n(picture.at(x, y), 3, static_cast<std::uint8_t>(grey));
    return picture;
}

TEST_F(QualityTest, TileListsDoNotLowerTheQualityOfAPictureWithLittleDetail) {
    const PipelineCase c;
    const auto frame = [&](double shift) {
        return evenButForAPatch(c.video({shift, 0}), 90 + static_cast<int>(4 * shift));
    };
    for (const bool withPoses : {false, true}) {
        const auto qualityWith = [&](bool lists) {
            PipelineOptions options;
            options.skips.tileLists = lists;
            Pipeline p(c.rig, options);
            const auto pose = [&](double x) {
                return withPoses ? std::optional(posed(x)) : std::nullopt;
            };
            p.setStill(evenButForAPatch(c.still(), 96).view(), {}, pose(0));
            for (const double shift : {2.0, 3.0, 4.0, 3.0, 2.0})
                p.run(frame(shift).view(), {}, pose(0.01 * shift));
            const auto classes = p.readTileClasses();
            EXPECT_GT(std::ranges::count(classes, TileClass::Blended), 2);
            EXPECT_GT(std::ranges::count(classes, TileClass::Enlarged), 20);
            return psnr(p.readImage(), evenButForAPatch(c.fine(p.outputSize(), {2, 0}), 98).bytes);
        };
        EXPECT_GT(qualityWith(true), std::max(37.0, qualityWith(false) - 0.1));
    }
}

std::vector<TileClass> classesAfterAChange(const SkipOptions& skips) {
    const PipelineCase c;
    PipelineOptions options;
    options.skips = skips;
    Pipeline p(c.rig, options);
    p.setStill(c.still().view(), {});
    TestPicture frame = c.video({2, 0});
    p.run(frame.view(), {});
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x)
            frame.at(x, y)[0] = static_cast<std::uint8_t>(255 - frame.at(x, y)[0]);
    p.run(frame.view(), {});
    return p.readTileClasses();
}

TEST_F(QualityTest, InModeBlendTilesWithoutWeightAreBlendedLikeAllOthers) {
    const PipelineCase c;
    Pipeline p(c.rig, {});
    p.setMode(SuperResMode::Blend);
    p.setStill(randomPicture(c.rig.still.size, 1).view(), {});
    TestPicture frame = c.video({2, 0});
    p.run(frame.view(), {});
    for (int y = 40; y < 52; ++y)
        for (int x = 40; x < 72; ++x)
            frame.at(x, y)[0] = static_cast<std::uint8_t>(255 - frame.at(x, y)[0]);
    p.run(frame.view(), {});
    EXPECT_LT(p.readStats().redrawn, 0.3);
    EXPECT_LT(p.readStats().meanConfidence, 0.5);
    const std::vector<TileClass> classes = p.readTileClasses();
    EXPECT_EQ(std::ranges::count(classes, TileClass::Enlarged), 0);
    EXPECT_GT(std::ranges::count(classes, TileClass::Blended), 2);
}

TEST_F(QualityTest, InModeBlendStillsOfEveryFormatKeepTheirColoursOnMixedEngines) {
    const PipelineCase c;
    EngineChoice mixed = EngineChoice::all(EngineKind::Simd);
    mixed.still = EngineKind::Gles;
    for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Bgra8, PixelFormat::Gray8}) {
        TestPicture still(c.rig.still.size, format, 0);
        TestPicture shown = c.still();
        for (int y = 0; y < shown.size.height; ++y)
            for (int x = 0; x < shown.size.width; ++x)
                for (int i = 0; i < (format == PixelFormat::Gray8 ? 1 : 3); ++i)
                    still.at(x, y)[i] = shown.at(x, y)[format == PixelFormat::Bgra8 ? 2 - i : i];
        std::vector<Image> images;
        for (const EngineChoice& engines : {EngineChoice::all(EngineKind::Simd), mixed}) {
            Pipeline p(c.rig, {.output = {}, .engines = engines});
            p.setMode(SuperResMode::Blend);
            p.setStill(still.view(), {});
            p.run(c.video({2, 0}).view(), {});
            images.push_back(p.readImage());
        }
        EXPECT_GT(psnr(images[0], images[1]), 45) << static_cast<int>(format);
    }
}

TEST_F(QualityTest, WithSkippingDisabledAllTilesAreProcessed) {
    const auto count = [](const std::vector<TileClass>& classes, TileClass which) {
        return std::ranges::count(classes, which);
    };
    const auto usual = classesAfterAChange({});
    EXPECT_GT(count(usual, TileClass::Unchanged), 60);
    EXPECT_EQ(count(classesAfterAChange({.tileLists = false}), TileClass::Unchanged), 0);
    const auto blended = classesAfterAChange({.enlargedTiles = false, .plainTiles = false});
    EXPECT_EQ(count(blended, TileClass::Unchanged), count(usual, TileClass::Unchanged));
    EXPECT_EQ(count(blended, TileClass::Trusted) + count(blended, TileClass::Enlarged), 0);
}

}  // namespace
}  // namespace mfar
