#include "tests/render/picture_driver.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace mfar {
namespace {

using namespace traced_pictures;

/// Root mean square error of the colours inside the objects' silhouettes [grey levels]. The
/// reference picture is sampled without filter and history.
double errorOf(const RenderedPicture& picture, double azimuth) {
    Driver exact({Slicing::Time, 256, 16, 0, 16});
    exact.look(azimuth);
    exact.settle();
    const RenderedPicture& truth = exact.shown.back();
    double squares = 0;
    int values = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (truth.id[i] == 0 || truth.id[i] == kCatcherId || truth.colour[i][3] < 255) continue;
        for (std::size_t c = 0; c < 3; ++c)
            squares += std::pow(double(truth.colour[i][c]) - picture.colour[i][c], 2);
        values += 3;
    }
    EXPECT_GT(values, 300);
    return std::sqrt(squares / values);
}

TEST(CarriedLight, FirstPictureIsShownAfterFewSamples) {
    Driver driver(kThirtyTwo, kProduct);
    driver.look(20);
    driver.untilShown(1);
    EXPECT_LT(driver.shown[0].samples, 0.4) << "a quarter of the pixels must suffice";
    driver.settle();
    EXPECT_GT(driver.shown.size(), 4U);
    const RenderedPicture &first = driver.shown.front(), &last = driver.shown.back();
    for (std::size_t i = 0; i < first.id.size(); ++i) {
        // The first picture has the id of the object at the pixel's centre. Later samples may also
        // hit a neighbouring object.
        if (first.id[i] == 0 || first.id[i] == kCatcherId || last.id[i] == kCatcherId) continue;
        ASSERT_EQ(first.id[i], last.id[i]) << "a pixel must keep its object";
    }
    const auto objectsOf = [](const RenderedPicture& p) {
        return std::ranges::count_if(p.id, [](int id) { return id != 0 && id != kCatcherId; });
    };
    EXPECT_GT(objectsOf(first), 0.85 * static_cast<double>(objectsOf(last)));
    EXPECT_GT(errorOf(first, 20), errorOf(last, 20));
}

TEST(CarriedLight, FirstPictureThatTakesLongIsShownAfterEvenFewerSamples) {
    Driver driver(kThirtyTwo, kProduct);
    driver.look(20);
    ASSERT_TRUE(driver.step());
    driver.look(20, Timestamp::fromSeconds(0.3));
    driver.untilShown(1);
    EXPECT_LT(driver.shown[0].samples, 0.15);
    driver.untilShown(2);
    EXPECT_GT(driver.shown[1].samples, 0.15);
    EXPECT_LT(driver.shown[1].samples, 0.4) << "the next turn must be shown, too";
}

TEST(CarriedLight, LightOfHardlyAnySamplesIsNotReused) {
    Driver fresh(kThirtyTwo, kProduct), going(kThirtyTwo, kProduct);
    fresh.look(26);
    fresh.untilShown(1);
    going.look(20);
    ASSERT_TRUE(going.step());
    going.look(20, Timestamp::fromSeconds(0.3));
    going.untilShown(1);
    ASSERT_LT(going.shown[0].samples, 0.15);
    going.look(26, Timestamp::fromSeconds(0.3));
    going.untilShown(2);
    ASSERT_TRUE(going.shows(26));
    EXPECT_EQ(going.shown[1].colour, fresh.shown[0].colour);
}

// Showing a picture takes time from tracing.
TEST(CarriedLight, PicturesAreShownSoSeldomThatMostOfTheTimeIsLeftForTracing) {
    Driver driver({Slicing::Time, 256, 1, 0, 2}, kProduct);
    driver.portionMs = 1;
    driver.showMs = 50;
    driver.look(20);
    driver.untilShown(1);
    double before = driver.tracedMs;
    for (std::size_t i = 2; i <= 4; ++i) {
        driver.untilShown(i);
        EXPECT_GE(driver.tracedMs - before, 200) << i;
        before = driver.tracedMs;
    }
    driver.look(26);
    driver.untilShown(5);
    EXPECT_TRUE(driver.shows(26));
    EXPECT_GE(driver.tracedMs - before, 200);
    before = driver.tracedMs;
    driver.look(80);
    driver.untilShown(6);
    EXPECT_TRUE(driver.shows(80));
    EXPECT_LT(driver.tracedMs - before, 200) << "a useless picture must be replaced at once";
}

TEST(CarriedLight, NextPictureReusesTheLightOfThePreviousPicture) {
    Driver fresh(kThirtyTwo, kProduct), going(kThirtyTwo, kProduct);
    fresh.look(26);
    fresh.untilShown(1);
    going.look(20);
    going.settle();
    const std::size_t before = going.shown.size();
    going.look(26);
    going.untilShown(before + 1);
    ASSERT_TRUE(going.shows(26));
    EXPECT_LT(going.shown.back().samples, 0.3);
    EXPECT_LT(errorOf(going.shown.back(), 26), 0.6 * errorOf(fresh.shown.back(), 26));
}

TEST(CarriedLight, NewPictureIsShownWhenItHasEnoughSamples) {
    TracedPolicy policy = kProduct;
    policy.soon = false;
    Driver driver(kThirtyTwo, policy);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    driver.look(23);
    EXPECT_FALSE(driver.step()) << "the shown picture must suffice for this view";
    driver.look(26);
    driver.untilShown(before + 1);
    EXPECT_GT(driver.shown.back().samples, 4)
        << "8 samples per object pixel and 2 per pixel of other surfaces give a mean above 4";
}

TEST(CarriedLight, NewSamplesSoonOutweighTheLightFromBeforeAChangeOfLighting) {
    Driver driver(kThirtyTwo, kProduct);
    const auto dark = std::make_shared<Scene>(*render_scenes::stillLife());
    dark->lighting.sun->irradiance *= 0.2F;
    driver.pictures.setScene(prepared(dark, 1, 1));
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    driver.pictures.setScene(preparedStillLife(1, 2));
    driver.look(20);
    driver.settle();
    ASSERT_GT(driver.shown.size(), before);
    Driver fresh(kThirtyTwo, kProduct);
    fresh.look(20);
    fresh.settle();
    EXPECT_LT(errorOf(driver.shown.back(), 20), errorOf(fresh.shown.back(), 20) + 2);
}

TEST(CarriedLight, AfterAChangeOfLightingTheRealSurfaceKeepsNothingOfTheOldLight) {
    Driver driver(kThirtyTwo, kProduct);
    driver.pictures.setScene(prepared(render_scenes::stillLifeLitBy({3, 0, 0}), 1, 1));
    for (int i = 0; i < 12; ++i)
        driver.look(20);
    driver.settle();
    driver.pictures.setScene(prepared(render_scenes::stillLifeLitBy({0, 3, 0}), 1, 2));
    driver.look(20);
    driver.settle();
    const RenderedPicture& shown = driver.shown.back();
    int shaded = 0, red = 0;
    for (std::size_t i = 0; i < shown.id.size(); ++i) {
        if (shown.id[i] != kCatcherId) continue;
        shaded += shown.colour[i][3] > 20 ? 1 : 0;
        red += shown.colour[i][0] > 0 ? 1 : 0;
    }
    EXPECT_GT(shaded, 20);
    EXPECT_EQ(red, 0);
}

TEST(CarriedLight, SurfacesWithUnchangedLightAreTracedOnce) {
    Driver driver({Slicing::Time, 2, 1, 0, 2}, kProduct);
    driver.size = {192, 144};
    // The black ball casts a shadow, but reflects hardly any light.
    const auto sunlit = std::make_shared<Scene>(*render_scenes::stillLife());
    sunlit->lighting.environment = nullptr;
    sunlit->objects.resize(1);
    Model black = *sunlit->objects[0].model;
    black.materials[0].baseColour.head<3>().setZero();
    sunlit->objects[0].model = std::make_shared<Model>(black);
    driver.pictures.setScene(prepared(sunlit, 1, 1));
    driver.look(20);
    driver.settle();
    const std::size_t all = driver.pictures.pixels();
    driver.look(26);
    driver.settle();
    EXPECT_LT(driver.pictures.pixels(), 0.9 * static_cast<double>(all));
    driver.pictures.setScene(prepared(sunlit, 1, 2));
    driver.look(20);
    driver.settle();
    EXPECT_GE(driver.pictures.pixels(), all) << "with new light, all pixels must be traced again";
}

TEST(CarriedLight, WhileTheCameraRestsEachPixelGetsOwnSamples) {
    Driver driver(kThirtyTwo, kProduct);
    driver.look(20);
    driver.settle();
    EXPECT_LT(driver.shown.back().samples, 32) << "the real surface gets a quarter of the samples";
    for (int i = 0; i < 12; ++i)
        driver.look(20);
    driver.settle();
    EXPECT_EQ(driver.shown.back().samples, 32);
    EXPECT_TRUE(driver.pictures.settled());
}

// Pixels at silhouettes cannot reuse the light of an earlier picture. So they need own samples.
TEST(CarriedLight, CameraAtRestSeesSmoothSilhouettes) {
    Driver driver({Slicing::Time, 64, 2, 1, 16}, kProduct), exact({Slicing::Time, 256, 16, 0, 16});
    driver.look(20);
    driver.settle();
    for (int i = 0; i < 12; ++i)
        driver.look(20);
    driver.settle();
    exact.look(20);
    exact.settle();
    const RenderedPicture &shown = driver.shown.back(), &truth = exact.shown.back();
    double squares = 0;
    int edges = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (truth.id[i] == kCatcherId || truth.colour[i][3] < 20 || truth.colour[i][3] > 235)
            continue;
        squares += std::pow(double(truth.colour[i][3]) - shown.colour[i][3], 2);
        ++edges;
    }
    EXPECT_GT(edges, 20);
    EXPECT_LT(std::sqrt(squares / edges), 25);
}

}  // namespace
}  // namespace mfar
