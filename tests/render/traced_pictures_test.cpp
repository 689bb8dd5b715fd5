#include "tests/render/picture_driver.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {
namespace {

using namespace traced_pictures;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(NextStep, StepDependsOnTheChangesOfTheView) {
    using enum TracedStep;
    // Arguments and result of nextStep(). The arguments are viewChange() since the views of the
    // shown and of the next picture; empty: there is no such picture.
    struct Case {
        std::optional<double> sinceShown, sinceNext;
        TracedStep step;
    };
    for (const auto& [sinceShown, sinceNext, step] : std::vector<Case>{
             {{}, {}, Start},      // no picture exists
             {{}, 9.0, Continue},  // no shown picture, so the next picture is finished in any
                                   // case
             {0.2, {}, Refine},
             {0.3, {}, Start},        // the change is above the limit of 0.25
             {kInfinite, {}, Start},  // the shown picture is useless from this view
             {1.1, 0.9, Continue},    // the camera approaches the next picture's view
             {0.6, 2.0, Start},       // the shown picture is nearer and serves meanwhile
             {0.1, 0.7, Drop},        // the camera came back to the shown picture's view
             {0.2, 0.7, Continue},    // the camera came back only in part
             // The camera moves fast, but is closer to the next picture's view than to the shown
             // one's.
             {2.0, 1.5, Continue},
             {1.5, 2.0, Start},  // the camera moves in another direction than predicted
         }) {
        EXPECT_EQ(nextStep(sinceShown, sinceNext, 0.25), step)
            << sinceShown.value_or(-1) << ' ' << sinceNext.value_or(-1);
    }
}

TEST(NextStep, HigherLimitOfChangeStartsTheNextPictureLater) {
    using enum TracedStep;
    EXPECT_EQ(nextStep(0.9, {}, 1), Refine);
    EXPECT_EQ(nextStep(1.0, {}, 1), Start);
    EXPECT_EQ(nextStep(0.4, 0.7, 1), Drop);
    EXPECT_EQ(nextStep(0.6, 0.7, 1), Continue);
}

TEST(TracedPictures, PictureIsRefinedWhileTheCameraRests) {
    Driver driver(kThirtyTwo);
    EXPECT_FALSE(driver.step()) << "without a view there is no work";
    driver.look(20);
    driver.settle();
    std::vector<double> samples;
    for (const RenderedPicture& picture : driver.shown)
        samples.push_back(picture.samples);
    EXPECT_EQ(samples, (std::vector<double>{1, 2, 4, 8, 16, 32}));
    EXPECT_TRUE(driver.pictures.settled());
    EXPECT_EQ(driver.pictures.finished(), 1U);
    driver.look(20.5);
    EXPECT_FALSE(driver.step()) << "the shown picture must suffice for this view";
}

TEST(TracedPictures, CameraThatComesToRestGetsAPictureOfItsView) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    for (int i = 0; i < 30; ++i) {
        driver.look(i % 2 == 0 ? 20.8 : 19.2);
        EXPECT_FALSE(driver.step()) << i;
    }
    for (int i = 0; i < 12; ++i)
        driver.look(22);
    driver.settle();
    ASSERT_EQ(driver.shown.size(), before + 1)
        << "only the picture of the view at rest may be shown";
    EXPECT_EQ(driver.shown.back().samples, 32);
    EXPECT_TRUE(driver.shows(22));
    EXPECT_TRUE(driver.pictures.settled());
    for (int i = 0; i < 30; ++i)
        driver.look(22 + 0.001 * (i % 2));  // poses are never exactly equal
    EXPECT_FALSE(driver.step());
}

TEST(TracedPictures, PictureIsFinishedWhileTheLightKeepsChanging) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    // The number `light` alone tells a new light. All scenes share one tracer, because building a
    // tracer takes longer than the steps below.
    const auto scene = preparedStillLife(1, 1);
    for (std::uint64_t light = 2; light < 400 && driver.shown.size() == before; ++light) {
        const auto relit = std::make_shared<PictureScene>(*scene);
        relit->light = light;
        driver.pictures.setScene(relit);
        driver.look(26);
        driver.step();
        driver.step();
    }
    EXPECT_GT(driver.shown.size(), before);
    EXPECT_TRUE(driver.shows(26));
}

TEST(TracedPictures, SpatialSlicesAreShownWhenTheyAreFinished) {
    SliceOptions slices = kThirtyTwo;
    slices.slicing = Slicing::Spatial;
    Driver driver(slices);
    driver.look(20);
    driver.settle();
    ASSERT_EQ(driver.shown.size(), 1U);
    EXPECT_EQ(driver.shown[0].samples, 32);
}

TEST(TracedPictures, PictureOfANewViewIsShownWhenItHasEnoughSamples) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    driver.look(26);
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown[before].samples, 8);
    EXPECT_TRUE(driver.shows(26));
}

TEST(TracedPictures, PictureOfAVeryDifferentViewIsReplacedAtOnce) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    driver.look(50);
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown[before].samples, 1);
}

TEST(TracedPictures, ReturningCameraGetsItsEarlierPictureRefined) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.untilShown(5);
    const double samples = driver.shown.back().samples;
    driver.look(26);
    ASSERT_TRUE(driver.step());
    ASSERT_TRUE(driver.step());
    driver.look(20.2);
    driver.settle();
    EXPECT_EQ(samples, 16);
    ASSERT_EQ(driver.shown.size(), 6U) << "the earlier picture must keep its samples";
    EXPECT_EQ(driver.shown[5].samples, 32);
    EXPECT_TRUE(driver.shows(20));
}

TEST(TracedPictures, PictureOfAMovingCameraIsFinishedIfItIsNearerThanTheShownOne) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    driver.look(26);
    driver.step();
    driver.look(29);
    driver.untilShown(before + 1);
    EXPECT_TRUE(driver.shows(26)) << "the camera at 29 degrees is nearer to 26 than to 20 degrees";
    driver.look(33);
    driver.settle();
    EXPECT_TRUE(driver.shows(33));
}

TEST(TracedPictures, ReversingCameraDiscardsTheNextPicture) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(26);
    driver.step();
    driver.look(14);
    driver.settle();
    EXPECT_TRUE(driver.shows(14));
    EXPECT_EQ(driver.pictures.finished(), 2U) << "the picture for 26 degrees must be discarded";
}

TEST(TracedPictures, NewObjectsAreShownAtOnceButNewLightOnlyWithEnoughSamples) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    std::size_t before = driver.shown.size();
    driver.pictures.setScene(preparedStillLife(1, 2));
    driver.look(20);
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown[before].samples, 8);
    driver.settle();
    before = driver.shown.size();
    driver.pictures.setScene(preparedStillLife(2, 3));
    driver.look(20);
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown.back().samples, 1);
}

TEST(TracedPictures, NewObjectsReplaceAPictureThatWasBegunAtRest) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    for (int i = 0; i < 12; ++i)
        driver.look(22);
    for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(driver.step());
    const std::size_t before = driver.shown.size();
    driver.pictures.setScene(preparedStillLife(2, 2));
    driver.look(22);
    EXPECT_TRUE(driver.pictures.toBegin());
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown.back().samples, 1);
}

TEST(TracedPictures, NothingIsTracedWhileADroppedPictureReadsTheShownFilm) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.untilShown(3);
    driver.look(26);
    ASSERT_TRUE(driver.step());
    const TracedPictures::Portion dropped = driver.pictures.next(1000);
    ASSERT_FALSE(dropped.slice.pixels.empty());
    driver.look(20.2);
    EXPECT_TRUE(driver.pictures.next(1000).slice.pixels.empty());
    driver.pictures.trace(dropped);
    driver.pictures.done(dropped, {}, 0);
    EXPECT_FALSE(driver.pictures.next(1000).slice.pixels.empty());
}

TEST(TracedPictures, WaitsForPortionsOfTheReplacedPicture) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(26);
    driver.step();
    const TracedPictures::Portion out = driver.pictures.next(1000);
    driver.look(14);
    EXPECT_FALSE(driver.pictures.toBegin()) << "the film of the replaced picture is in use";
    EXPECT_TRUE(driver.pictures.next(1000).slice.pixels.empty());
    driver.pictures.trace(out);
    driver.pictures.done(out, {}, 0);
    EXPECT_TRUE(driver.pictures.toBegin());
}

TEST(TracedPictures, ViewWithoutObjectsGivesAnEmptyPicture) {
    Driver driver(kThirtyTwo);
    RenderView away = render_scenes::viewFrom(kTracedSize, 20);
    away.T_world_camera.translation.z() += 100;
    driver.pictures.look(away, away, {});
    driver.settle();
    ASSERT_EQ(driver.shown.size(), 1U);
    for (const std::uint8_t id : driver.shown[0].id)
        EXPECT_EQ(id, 0);
    EXPECT_TRUE(driver.pictures.settled());
}

}  // namespace
}  // namespace mfar
