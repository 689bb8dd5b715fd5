#include "pipeline/slices/picture_coarseness.h"
#include "tests/render/picture_driver.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

using namespace traced_pictures;

constexpr double kWithin = 0.8, kPixels = 10000;
constexpr Size kCoarsestSize{kTracedSize.width / 4, kTracedSize.height / 4};

TracedPolicy timed() {
    TracedPolicy out = kProduct;
    out.shownWithin = kWithin;
    return out;
}

/// Begins the first picture. After half a second, not a single ray is traced yet.
void beginTooSlowly(Driver& driver) {
    driver.look(20);
    EXPECT_TRUE(driver.step()) << "begins the picture, but traces nothing";
    driver.look(20, Timestamp::fromSeconds(0.5));
}

TEST(PictureCoarseness, WithoutALimitEveryPictureHasFullResolution) {
    PictureCoarseness coarseness(0);
    EXPECT_FALSE(coarseness.lacksSpeed());
    EXPECT_EQ(coarseness.chosen(kPixels, 0), 0);
    coarseness.learn(kPixels, 0, 1000);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    EXPECT_EQ(coarseness.chosen(kPixels, 0), 0);
}

TEST(PictureCoarseness, PictureIsAsFineAsTheTimeAllows) {
    PictureCoarseness coarseness(kWithin);
    // Each level halves the number of pixels.
    coarseness.learn(kPixels, 0, 3 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels), 2);
    EXPECT_EQ(coarseness.chosen(kPixels / 4), 0);
    EXPECT_EQ(coarseness.chosen(4 * kPixels), PictureCoarseness::kCoarsest);
    EXPECT_EQ(coarseness.chosen(1e9), PictureCoarseness::kCoarsest);
    coarseness.learn(kPixels, 2, kWithin / 4);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    // A picture that is shown in the frame in which it began takes no measurable time.
    coarseness.learn(kPixels, 2, 0);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    coarseness.learn(0, 2, 1000);
    EXPECT_EQ(coarseness.chosen(kPixels), 0) << "a picture without objects tells no speed";
}

TEST(PictureCoarseness, SmallChangesOfTheSpeedKeepTheResolution) {
    PictureCoarseness coarseness(kWithin);
    coarseness.begin(1);
    for (const double change : {0.75, 0.95}) {
        coarseness.learn(kPixels, 0, change * kWithin);
        EXPECT_EQ(coarseness.chosen(kPixels), 1) << change;
    }
    coarseness.learn(kPixels, 0, 0.6 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    coarseness.begin(0);
    coarseness.learn(kPixels, 0, 0.95 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
}

TEST(PictureCoarseness, ResolutionIsTheLowestUntilTheSpeedIsKnown) {
    PictureCoarseness coarseness(kWithin);
    EXPECT_TRUE(coarseness.lacksSpeed());
    EXPECT_EQ(coarseness.chosen(kPixels), PictureCoarseness::kCoarsest);
    EXPECT_EQ(coarseness.chosen(1, 0), PictureCoarseness::kCoarsest);
    coarseness.learn(0, 2, 1000);
    coarseness.learnFromLook(0, 1000, 1000);
    EXPECT_TRUE(coarseness.lacksSpeed()) << "a picture without objects tells no speed";
    coarseness.learn(kPixels, 0, 0);
    EXPECT_FALSE(coarseness.lacksSpeed());
}

TEST(PictureCoarseness, IfNothingIsShownBeforeAPictureItHasHalfTheTime) {
    PictureCoarseness coarseness(kWithin);
    coarseness.learn(kPixels, 0, 0.9 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    EXPECT_EQ(coarseness.chosen(kPixels, 0), 1);
    coarseness.learn(kPixels, 0, 0.45 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels, 0), 0);
    EXPECT_EQ(coarseness.chosen(kPixels, 0.1 * kWithin), 1);
    EXPECT_EQ(coarseness.chosen(kPixels, 10 * kWithin), PictureCoarseness::kCoarsest);
}

TEST(PictureCoarseness, RaysThroughThePixelsCentresTellTheSpeed) {
    PictureCoarseness coarseness(kWithin);
    coarseness.setBudget({.ms = 2, .extraMs = 2, .secondsPerFrame = 0.1});
    // With 4 ms per frame, the rays take a tenth or a half of the limit.
    const double ms = 4 * kWithin / 0.1;
    coarseness.learnFromLook(kPixels, 0.1 * ms, 0);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    coarseness.learnFromLook(kPixels, 0.5 * ms, 0);
    EXPECT_EQ(coarseness.chosen(kPixels), 0);
    EXPECT_EQ(coarseness.chosen(2 * kPixels), 1) << "the rest of a picture takes time, too";
    // On a loaded processor, the threads wait.
    coarseness.learnFromLook(kPixels, 0.1 * ms, 2 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels), 2);
    coarseness.learnFromLook(kPixels, 0.1 * ms, 0.1);
    EXPECT_EQ(coarseness.chosen(kPixels), 0) << "a frame may have passed in an instant";
}

TEST(PictureCoarseness, LaterPicturesHaveNoExtraTime) {
    PictureCoarseness coarseness(kWithin);
    coarseness.setBudget({.ms = 2, .extraMs = 6});
    coarseness.learn(kPixels, 0, 0.9 * kWithin);
    EXPECT_EQ(coarseness.chosen(kPixels), 2);
}

TEST(PictureCoarseness, CoarserViewShowsTheSamePartOfTheWorld) {
    const RenderView view = render_scenes::viewFrom({640, 480}, 20);
    EXPECT_EQ(coarsened(view, 0).camera, view.camera);
    const RenderView half = coarsened(view, 2);
    EXPECT_EQ(half.camera.size, (Size{320, 240}));
    EXPECT_EQ(coarsened(view, 1).camera.size, (Size{453, 339}));
    EXPECT_EQ(coarsened(view, 4).camera.size, (Size{160, 120}));
    EXPECT_EQ(half.T_world_camera.translation, view.T_world_camera.translation);
    // Corners of the pictures, half a pixel outside the centres of the outermost pixels.
    const Eigen::Vector2d corner(639.5, 479.5), coarseCorner(319.5, 239.5);
    EXPECT_LT((half.camera.unproject(coarseCorner) - view.camera.unproject(corner)).norm(), 1e-9);
}

TEST(TracedPictures, FirstPictureOnALoadedProcessorIsCoarse) {
    Driver driver(kThirtyTwo, timed());
    beginTooSlowly(driver);
    driver.untilShown(1);
    EXPECT_EQ(driver.shown.back().camera.size, kCoarsestSize);
    EXPECT_EQ(driver.shown.back().colour.size(), 12U * 9U);
    EXPECT_TRUE(driver.shows(20));
}

TEST(TracedPictures, ResolutionOfTheFirstPictureDependsOnTheProcessor) {
    const auto widthOf = [](double portionMs) {
        Driver driver(kThirtyTwo, timed());
        driver.portionMs = portionMs;
        driver.look(20);
        driver.untilShown(1);
        EXPECT_TRUE(driver.shows(20));
        return driver.shown.back().camera.size.width;
    };
    EXPECT_EQ(widthOf(4 * FrameBudget{}.ms), kCoarsestSize.width);
    EXPECT_EQ(widthOf(FrameBudget{}.ms), 17);
    EXPECT_EQ(widthOf(0.1 * FrameBudget{}.ms), kTracedSize.width);
}

TEST(TracedPictures, FastFirstPictureHasFullResolution) {
    Driver driver(kThirtyTwo, timed());
    driver.look(20);
    driver.untilShown(1);
    EXPECT_EQ(driver.shown.back().camera.size, kTracedSize);
}

// A portion of an abandoned picture still tells the speed, but does not change the next picture.
TEST(TracedPictures, FirstPictureCanBeAbandoned) {
    Driver driver(kThirtyTwo, timed());
    driver.look(20);
    EXPECT_TRUE(driver.step()) << "begins the picture";
    const TracedPictures::Portion portion = driver.pictures.next(1000);
    driver.pictures.setScene(preparedStillLife(2, 2));
    driver.look(25);
    driver.pictures.trace(portion);
    driver.pictures.done(portion, {}, 0);
    driver.untilShown(1);
    EXPECT_TRUE(driver.shows(25));
    EXPECT_EQ(driver.shown.back().camera.size, kTracedSize);
}

TEST(TracedPictures, CoarsePictureIsReplacedByAFinerOneOfTheSameView) {
    Driver driver(kThirtyTwo, timed());
    driver.portionMs = 4 * FrameBudget{}.ms;  // a slow processor
    driver.look(20);
    driver.settle();
    ASSERT_EQ(driver.shown.back().camera.size, kCoarsestSize);
    const std::size_t before = driver.shown.size();
    driver.look(20, Timestamp::fromSeconds(0.6));
    driver.step();
    driver.look(20, Timestamp::fromSeconds(0.7));
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown.back().camera.size, kTracedSize);
    EXPECT_TRUE(driver.shows(20));
}

TEST(TracedPictures, ManySamplesOfOldObjectsDoNotMakeAPictureOfNewObjectsFiner) {
    Driver driver(kThirtyTwo, timed());
    beginTooSlowly(driver);
    driver.settle();
    ASSERT_EQ(driver.shown.back().samples, 32);
    driver.pictures.setScene(preparedStillLife(2, 2));
    driver.look(20, Timestamp::fromSeconds(1));
    driver.step();
    const std::size_t before = driver.shown.size();
    driver.look(20, Timestamp::fromSeconds(1.5));
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown.back().camera.size, kCoarsestSize);
}

TEST(TracedPictures, SlowPicturesOfAMovingCameraAreCoarse) {
    Driver driver(kThirtyTwo, timed());
    driver.look(20);
    driver.untilShown(1);
    driver.settle();
    // The next picture takes almost twice the time allowed, so the one after it has half the
    // pixels.
    driver.look(23.5, Timestamp::fromSeconds(1));
    driver.step();
    driver.look(24, Timestamp::fromSeconds(1 + 1.8 * kWithin));
    driver.settle();
    EXPECT_TRUE(driver.shows(23.5));
    EXPECT_EQ(driver.shown.back().camera.size, kTracedSize);
    driver.look(27.5, Timestamp::fromSeconds(3));
    driver.settle();
    EXPECT_TRUE(driver.shows(27.5));
    EXPECT_EQ(driver.shown.back().camera.size, (Size{34, 25}));
}

TEST(TracedPictures, CameraAtRestGetsFullResolutionOnASlowProcessor) {
    Driver driver(kThirtyTwo, timed());
    double now = 0;
    // In each frame of 0.5 s, one portion of work is done: a ray through each pixel of a tile.
    for (int i = 0; i < 400; ++i) {
        driver.look(20, Timestamp::fromSeconds(now += 0.5));
        driver.step();
    }
    EXPECT_EQ(driver.shown.front().camera.size, kCoarsestSize);
    EXPECT_EQ(driver.shown.back().camera.size, kTracedSize);
    EXPECT_LE(driver.shown.at(1).samples, 2) << "full resolution must not wait for many samples";
    EXPECT_EQ(driver.shown.at(1).camera.size, kTracedSize);
    driver.settle();
    driver.look(20, Timestamp::fromSeconds(now + 0.5));
    EXPECT_FALSE(driver.step());
    EXPECT_TRUE(driver.pictures.settled());
}

TEST(TracedPictures, FirstPictureOfNewObjectsIsCoarseEvenIfTheCameraRests) {
    Driver driver(kThirtyTwo, timed());
    driver.portionMs = 4 * FrameBudget{}.ms;  // a slow processor
    double now = 0;
    const auto rest = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            driver.look(20, Timestamp::fromSeconds(now += 0.5));
            driver.step();
        }
    };
    rest(400);
    ASSERT_EQ(driver.shown.back().camera.size, kTracedSize);
    driver.pictures.setScene(preparedStillLife(2, 2));
    const std::size_t before = driver.shown.size();
    rest(400);
    ASSERT_GT(driver.shown.size(), before);
    EXPECT_LT(driver.shown.at(before).camera.size.width, kTracedSize.width);
    EXPECT_EQ(driver.shown.back().camera.size, kTracedSize);
}

TEST(TracedPictures, FinishedCoarsePictureIsReplacedByAFinerOne) {
    for (const int samples : {2, 3}) {
        SliceOptions few = kThirtyTwo;
        few.samples = samples;
        Driver driver(few, timed());
        driver.portionMs = 4 * FrameBudget{}.ms;
        // The camera trembles, so it never counts as resting.
        for (int i = 0; i < 300; ++i) {
            driver.look(20 + 0.4 * (i % 2), Timestamp::fromSeconds(i / 30.0));
            driver.step();
            driver.step();
        }
        EXPECT_EQ(driver.shown.back().camera.size, kTracedSize) << samples;
    }
}

TEST(TracedPictures, ChangeOfLightDoesNotLowerTheResolution) {
    const auto widthAfter = [](bool relit) {
        Driver driver(kThirtyTwo, timed());
        driver.portionMs = 4 * FrameBudget{}.ms;
        driver.look(20);
        driver.settle();
        driver.look(20, Timestamp::fromSeconds(0.6));
        driver.step();
        driver.look(20, Timestamp::fromSeconds(1.1));
        driver.untilShown(driver.shown.size() + 1);
        driver.look(20, Timestamp::fromSeconds(1.2));
        driver.settle();
        if (relit) {
            auto scene = std::make_shared<PictureScene>(*driver.pictures.scene());
            scene->light = 2;
            driver.pictures.setScene(scene);
        }
        const double azimuth = relit ? 20 : 26;
        driver.look(azimuth, Timestamp::fromSeconds(4));
        driver.step();
        driver.look(azimuth + 0.1, Timestamp::fromSeconds(4.1));
        driver.untilShown(driver.shown.size() + 1);
        return driver.shown.back().camera.size.width;
    };
    EXPECT_EQ(widthAfter(true), widthAfter(false));
}

}  // namespace
}  // namespace mfar
