#include "pipeline/pipeline.h"
#include "tests/engine/gl_test.h"
#include "tests/learn/sensor_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

using twin::Grey;
using Bytes = std::vector<std::uint8_t>;

const PixelRect kHidden{0, 0, 400, 768};
// Pixels are not compared within this distance of a border of the picture or of kHidden [px].
constexpr int kRoom = 24;

Grey hidden(const Grey& scene) {
    const Grey front = sharpDiscs(77);
    return twin::greyOf(
        scene.size, [&](int x, int y) { return x < kHidden.x1 ? front.at(x, y) : scene.at(x, y); });
}

/// Base of tests with a scene, a still that shows all of it, and a still that lacks its left part.
class SecondStillTest : public GlTest {
protected:
    static Pipeline made(double share, const EngineChoice& engines) {
        Pipeline out(discsRig(), {.output = {}, .engines = engines});
        out.setQuality({.secondShare = share});
        return out;
    }
    static void setStill(Pipeline& pipeline, const Bytes& still) {
        pipeline.setStill(
            {still.data(), kDiscsStill, std::size_t(kDiscsStill.width), PixelFormat::Gray8}, {});
    }
    FrameStats run(Pipeline& pipeline) {
        pipeline.redraw();
        pipeline.run(
            {video_.data(), kDiscsVideo, std::size_t(kDiscsVideo.width), PixelFormat::Gray8}, {});
        return pipeline.readStats();
    }
    double error(const Pipeline& pipeline, bool inHidden) const {
        const Bytes picture = pipeline.readImage();
        double sum = 0, count = 0;
        for (int y = kRoom; y < kDiscsStill.height - kRoom; ++y)
            for (int x = kRoom; x < kDiscsStill.width - kRoom; ++x) {
                if (inHidden ? x >= kHidden.x1 - kRoom : x < kHidden.x1 + kRoom) continue;
                const double off =
                    picture[4 * (std::size_t(y) * kDiscsStill.width + x)] - scene_.at(x, y);
                sum += off * off;
                ++count;
            }
        return sum / count;
    }

    const Grey scene_ = sharpDiscs(1);
    const Bytes whole_ = bytesOf(scene_), part_ = bytesOf(hidden(scene_)),
                video_ = bytesOf(videoOf(scene_, {}));
};

struct Engines {
    const char* name;
    EngineChoice choice;
};

EngineChoice drawnBy(EngineKind kind) {
    EngineChoice out =
        EngineChoice::all(kind == EngineKind::Gles ? EngineKind::Simd : EngineKind::Gles);
    out.detail = kind;
    return out;
}

class SecondStillOfEngines : public SecondStillTest, public testing::WithParamInterface<Engines> {
protected:
    static Pipeline made(double share) { return SecondStillTest::made(share, GetParam().choice); }
};
INSTANTIATE_TEST_SUITE_P(Engines, SecondStillOfEngines,
                         testing::Values(Engines{"simd", EngineChoice::all(EngineKind::Simd)},
                                         Engines{"gles", EngineChoice::all(EngineKind::Gles)},
                                         Engines{"drawn_by_gles", drawnBy(EngineKind::Gles)},
                                         Engines{"drawn_by_simd", drawnBy(EngineKind::Simd)}),
                         [](const auto& tested) { return std::string(tested.param.name); });

class SecondStill : public SecondStillTest {
protected:
    static Pipeline made(double share) {
        return SecondStillTest::made(share, EngineChoice::all(EngineKind::Simd));
    }
};

TEST_P(SecondStillOfEngines, ShowsPartsThatTheNewestStillLacks) {
    Pipeline one = made(0), two = made(1);
    FrameStats stats;
    for (Pipeline* pipeline : {&one, &two}) {
        setStill(*pipeline, whole_);
        run(*pipeline);
        setStill(*pipeline, part_);
        stats = run(*pipeline);
    }
    EXPECT_GT(stats.matchedSecond, 30) << "the newest still lacks 72 tiles";
    EXPECT_GT(stats.showSecond, 30);
    EXPECT_GT(stats.explained, one.readStats().explained + 0.1);
    EXPECT_LT(error(two, true), 0.5 * error(one, true));
    EXPECT_LT(error(two, false), 1.02 * error(one, false));
}

TEST_P(SecondStillOfEngines, IsNotMatchedWhereTheNewestStillShowsAll) {
    Pipeline pipeline = made(1);
    setStill(pipeline, whole_);
    EXPECT_EQ(run(pipeline).matchedSecond, 0) << "there is no second still yet";
    setStill(pipeline, whole_);
    for (int frame = 0; frame < 3; ++frame)
        EXPECT_LE(run(pipeline).matchedSecond, 2)
            << "only tiles at the picture's border may be matched";
    pipeline.setMeasure(true);
    pipeline.run({video_.data(), kDiscsVideo, std::size_t(kDiscsVideo.width), PixelFormat::Gray8},
                 {});
    for (const StageTime& stage : pipeline.stageTimes())
        EXPECT_STRNE(stage.stage, "second still")
            << "an unchanged frame must not be matched with the second still";
}

TEST_F(SecondStill, IsMatchedInNoMoreTilesThanItsConfiguredShare) {
    Pipeline pipeline = made(0.05);
    setStill(pipeline, whole_);
    run(pipeline);
    setStill(pipeline, part_);
    EXPECT_EQ(run(pipeline).matchedSecond, 10) << "5 % of 192 tiles, rounded up";
    pipeline.setQuality({.secondShare = 0});
    EXPECT_EQ(run(pipeline).matchedSecond, 0);
    pipeline.setQuality({.secondShare = 0.1});
    EXPECT_EQ(run(pipeline).matchedSecond, 20) << "a share of 0 must not drop the second still";
    setStill(pipeline, whole_);
    pipeline.setQuality({.secondShare = 0});
    setStill(pipeline, part_);
    pipeline.setQuality({.secondShare = 1});
    EXPECT_EQ(run(pipeline).matchedSecond, 0)
        << "while the share is 0, a replaced still must not be kept as the second still";
}

TEST_F(SecondStill, IsUsedOnlyInModeDetailWithLearnedFilters) {
    Pipeline pipeline = made(1);
    setStill(pipeline, whole_);
    run(pipeline);
    setStill(pipeline, part_);
    pipeline.setMode(SuperResMode::Blend);
    EXPECT_EQ(run(pipeline).matchedSecond, 0);
    pipeline.setMode(SuperResMode::Off);
    EXPECT_EQ(run(pipeline).matchedSecond, 0);
    pipeline.setQuality({.learned = false, .secondShare = 1});
    EXPECT_EQ(run(pipeline).matchedSecond, 0);
    pipeline.setQuality({.secondShare = 1});
    EXPECT_GT(run(pipeline).matchedSecond, 30);
}

TEST_P(SecondStillOfEngines, IsDroppedTogetherWithTheNewestStill) {
    Pipeline pipeline = made(1), fresh = made(1);
    setStill(pipeline, whole_);
    run(pipeline);
    setStill(pipeline, part_);
    run(pipeline);
    pipeline.dropStill();
    EXPECT_FALSE(run(pipeline).usedStill);
    for (int frame = 0; frame < 3; ++frame)  // until both pipelines have measured the same noise
        run(fresh);
    setStill(pipeline, part_);
    setStill(fresh, part_);
    EXPECT_EQ(run(pipeline).matchedSecond, 0);
    run(fresh);
    EXPECT_EQ(pipeline.readImage(), fresh.readImage());
}

TEST_F(SecondStill, IsKeptWhileNewStillsMissTheSameParts) {
    Pipeline pipeline = made(1);
    setStill(pipeline, whole_);
    run(pipeline);
    for (int still = 0; still < 4; ++still) {
        setStill(pipeline, part_);
        EXPECT_GT(run(pipeline).showSecond, 30) << still;
    }
}

TEST_F(SecondStillTest, AllEnginesGiveTheSamePicture) {
    Pipeline simd = made(1, EngineChoice::all(EngineKind::Simd));
    std::vector<FrameStats> stats;
    const auto show = [&](Pipeline& pipeline) {
        setStill(pipeline, whole_);
        run(pipeline);
        EXPECT_FALSE(pipeline.secondStill());
        setStill(pipeline, part_);
        EXPECT_TRUE(pipeline.secondStill());
        stats.push_back(run(pipeline));
        return pipeline.readImage();
    };
    const Bytes wanted = show(simd);
    for (const EngineChoice& engines : {EngineChoice::all(EngineKind::Gles),
                                        drawnBy(EngineKind::Gles), drawnBy(EngineKind::Simd)}) {
        Pipeline other = made(1, engines);
        const Bytes got = show(other);
        double squares = 0;
        for (std::size_t i = 0; i < got.size(); ++i)
            squares += std::pow(double(got[i]) - wanted[i], 2);
        EXPECT_LT(std::sqrt(squares / static_cast<double>(got.size())), 1)
            << nameOf(engines.detail);
        EXPECT_NEAR(stats.back().matchedSecond, stats.front().matchedSecond, 3);
        EXPECT_NEAR(stats.back().showSecond, stats.front().showSecond, 5);
        EXPECT_NEAR(stats.back().explained, stats.front().explained, 0.03);
    }
}

TEST_F(SecondStill, ReducesTheErrorAlsoIfItsExposureDiffers) {
    const Bytes dark = bytesOf(twin::greyOf(kDiscsStill, [&](int x, int y) {
        return 255 * 0.7 * std::pow(scene_.at(x, y) / 255, 1.3);
    }));
    Pipeline one = made(0), two = made(1);
    for (Pipeline* pipeline : {&one, &two}) {
        setStill(*pipeline, dark);
        run(*pipeline);
        setStill(*pipeline, part_);
        run(*pipeline);
    }
    EXPECT_LT(error(two, true), 0.6 * error(one, true));
    EXPECT_LT(error(two, false), 1.02 * error(one, false));
}

TEST_F(SecondStill, OfAnotherSceneDoesNotIncreaseTheError) {
    const Bytes other = bytesOf(sharpDiscs(5));
    Pipeline one = made(0), two = made(1);
    for (Pipeline* pipeline : {&one, &two}) {
        setStill(*pipeline, other);
        run(*pipeline);
        setStill(*pipeline, part_);
        run(*pipeline);
    }
    EXPECT_LT(error(two, true), 1.01 * error(one, true));
    EXPECT_LT(error(two, false), 1.01 * error(one, false));
}

}  // namespace
}  // namespace mfar
