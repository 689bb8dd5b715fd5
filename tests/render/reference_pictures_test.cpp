#include "pipeline/slices/reference_pictures.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {
namespace {

constexpr Size kReferenceSize{48, 36};
constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::shared_ptr<const ReferenceScene> prepared(const std::shared_ptr<const Scene>& scene,
                                               std::uint64_t objects, std::uint64_t light) {
    auto out = std::make_shared<ReferenceScene>();
    out->tracer = std::make_shared<PathTracer>(scene);
    out->balls = objectBalls(*scene);
    out->objects = objects;
    out->light = light;
    return out;
}

std::shared_ptr<const ReferenceScene> preparedStillLife(std::uint64_t objects,
                                                        std::uint64_t light) {
    return prepared(render_scenes::stillLife(), objects, light);
}

/// Neither filter nor history: every pixel is sampled.
constexpr ReferencePolicy kPlain{{4, 0.2}, 8, false, false};
constexpr ReferencePolicy kProduct{{4, 0.2}, 8, true, true};

/// Does one by one what the threads of a renderer do, and keeps what was shown.
class Driver {
public:
    explicit Driver(const SliceOptions& slices, const ReferencePolicy& policy = kPlain)
        : pictures(slices, policy) {
        pictures.setScene(preparedStillLife(1, 1));
    }

    void look(double azimuth) {
        const RenderView view = render_scenes::viewFrom(size, azimuth);
        pictures.look(view, view, {});
    }
    /// True if there was something to do.
    bool step() {
        if (pictures.toBegin()) {
            pictures.begin();
            return true;
        }
        if (pictures.toShow()) {
            RenderedPicture& out = shown.emplace_back();
            pictures.beginShow({}, out);
            while (!pictures.resolver().complete()) {
                const PictureResolver::Portion rows = pictures.resolver().next(100);
                pictures.resolver().run(rows);
                pictures.resolver().done(rows);
            }
            pictures.endShow(out);
            return true;
        }
        const ReferencePictures::Portion portion = pictures.next(1000);
        if (portion.slice.pixels.empty()) return false;
        pictures.trace(portion);
        pictures.done(portion, {});
        return true;
    }
    void settle() {
        while (step()) {
        }
    }
    void untilShown(std::size_t pictures) {
        while (shown.size() < pictures)
            ASSERT_TRUE(step());
    }
    /// Whether the picture shown last was made for the view.
    [[nodiscard]] bool shows(double azimuth) const {
        const RigidTransform there =
            render_scenes::viewFrom(kReferenceSize, azimuth).T_world_camera;
        return !shown.empty() && shown.back().T_world_camera.translation == there.translation;
    }

    Size size = kReferenceSize;
    ReferencePictures pictures;
    std::vector<RenderedPicture> shown;
};

constexpr SliceOptions kThirtyTwo{Slicing::Time, 32, 1, 0, 2};

TEST(NextStep, FollowsTheCamera) {
    using enum ReferenceStep;
    struct Case {
        std::optional<double> sinceShown, sinceNext;
        ReferenceStep step;
    };
    for (const auto& [sinceShown, sinceNext, step] : std::vector<Case>{
             {{}, {}, Start},         // nothing yet
             {{}, 9.0, Continue},     // the first one, wherever the camera is
             {0.2, {}, Refine},       // it is new
             {0.3, {}, Start},        // the next one takes over its light
             {kInfinite, {}, Start},  // it never did
             {1.1, 0.9, Continue},    // on the way
             {0.6, 2.0, Start},       // the same, and the shown one serves meanwhile
             {0.1, 0.7, Drop},        // come back
             {0.2, 0.7, Continue},    // not quite
             {2.0, 1.5, Continue},    // too fast, but better than what is shown
             {1.5, 2.0, Start},       // another way than was predicted
         }) {
        EXPECT_EQ(nextStep(sinceShown, sinceNext), step)
            << sinceShown.value_or(-1) << ' ' << sinceNext.value_or(-1);
    }
}

TEST(ReferencePictures, ACameraAtRestSeesItsPictureGetFiner) {
    Driver driver(kThirtyTwo);
    EXPECT_FALSE(driver.step()) << "no view, no work";
    driver.look(20);
    driver.settle();
    std::vector<double> samples;
    for (const RenderedPicture& picture : driver.shown)
        samples.push_back(picture.samples);
    EXPECT_EQ(samples, (std::vector<double>{1, 4, 16, 32}));
    EXPECT_TRUE(driver.pictures.settled());
    EXPECT_EQ(driver.pictures.finished(), 1U);
    driver.look(20.5);
    EXPECT_FALSE(driver.step()) << "it serves";
}

TEST(ReferencePictures, ACameraThatComesToRestGetsAPictureOfItsOwnView) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    for (int i = 0; i < 30; ++i) {  // it still moves, and the picture serves
        driver.look(i % 2 == 0 ? 20.8 : 19.2);
        EXPECT_FALSE(driver.step()) << i;
    }
    for (int i = 0; i < 12; ++i)
        driver.look(22);
    driver.settle();
    ASSERT_EQ(driver.shown.size(), before + 1) << "a worse one was shown";
    EXPECT_EQ(driver.shown.back().samples, 32);
    EXPECT_TRUE(driver.shows(22));
    EXPECT_TRUE(driver.pictures.settled());
    for (int i = 0; i < 30; ++i)
        driver.look(22 + 0.001 * (i % 2));  // a pose is never quite the same
    EXPECT_FALSE(driver.step());
}

TEST(ReferencePictures, APictureIsFinishedThoughTheLightChangesAllTheTime) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    const std::size_t before = driver.shown.size();
    for (std::uint64_t light = 2; light < 400 && driver.shown.size() == before; ++light) {
        driver.pictures.setScene(preparedStillLife(1, light));
        driver.look(26);
        driver.step();
        driver.step();
    }
    EXPECT_GT(driver.shown.size(), before);
    EXPECT_TRUE(driver.shows(26));
}

TEST(ReferencePictures, SpatialSlicesAreShownWhenTheyAreFinished) {
    SliceOptions slices = kThirtyTwo;
    slices.slicing = Slicing::Spatial;
    Driver driver(slices);
    driver.look(20);
    driver.settle();
    ASSERT_EQ(driver.shown.size(), 1U);
    EXPECT_EQ(driver.shown[0].samples, 32);
}

TEST(ReferencePictures, AnotherViewsPictureIsShownWithEnoughSamples) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(26);
    driver.untilShown(5);
    EXPECT_EQ(driver.shown[4].samples, 8);
    EXPECT_TRUE(driver.shows(26));
}

TEST(ReferencePictures, AHopelesslyOldPictureIsReplacedAtOnce) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(50);
    driver.untilShown(5);
    EXPECT_EQ(driver.shown[4].samples, 1);
}

TEST(ReferencePictures, ACameraThatComesBackFindsItsPictureAndRefinesIt) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.untilShown(3);
    driver.look(26);
    ASSERT_TRUE(driver.step());  // it is begun
    ASSERT_TRUE(driver.step());
    driver.look(20.2);
    driver.settle();
    ASSERT_EQ(driver.shown.size(), 4U);
    EXPECT_EQ(driver.shown[3].samples, 32) << "the samples it had are not lost";
    EXPECT_TRUE(driver.shows(20));
}

TEST(ReferencePictures, ACameraThatGoesOnFindsThePictureOfItsWay) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(26);
    driver.step();
    driver.look(29);
    driver.untilShown(5);
    EXPECT_TRUE(driver.shows(26)) << "nearer than what is shown";
    driver.look(33);
    driver.settle();
    EXPECT_TRUE(driver.shows(33));
}

TEST(ReferencePictures, ACameraThatTurnsRoundIsFollowed) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(26);
    driver.step();
    driver.look(14);
    driver.settle();
    EXPECT_TRUE(driver.shows(14));
    EXPECT_EQ(driver.pictures.finished(), 2U) << "that of 26 degrees was given up";
}

TEST(ReferencePictures, NewObjectsAreShownAtOnceNewLightWhenItIsCalm) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.pictures.setScene(preparedStillLife(1, 2));
    driver.look(20);
    driver.untilShown(5);
    EXPECT_EQ(driver.shown[4].samples, 8);
    driver.settle();
    const std::size_t before = driver.shown.size();
    driver.pictures.setScene(preparedStillLife(2, 3));
    driver.look(20);
    driver.untilShown(before + 1);
    EXPECT_EQ(driver.shown.back().samples, 1);
}

TEST(ReferencePictures, WaitsForPortionsOfThePictureThatGoes) {
    Driver driver(kThirtyTwo);
    driver.look(20);
    driver.settle();
    driver.look(26);
    driver.step();
    const ReferencePictures::Portion out = driver.pictures.next(1000);
    driver.look(14);
    EXPECT_FALSE(driver.pictures.toBegin()) << "its film is in use";
    EXPECT_TRUE(driver.pictures.next(1000).slice.pixels.empty());
    driver.pictures.trace(out);
    driver.pictures.done(out, {});
    EXPECT_TRUE(driver.pictures.toBegin());
}

TEST(ReferencePictures, NothingInViewIsShownAsNothing) {
    Driver driver(kThirtyTwo);
    RenderView away = render_scenes::viewFrom(kReferenceSize, 20);
    away.T_world_camera.translation.z() += 100;
    driver.pictures.look(away, away, {});
    driver.settle();
    ASSERT_EQ(driver.shown.size(), 1U);
    for (const std::uint8_t id : driver.shown[0].id)
        EXPECT_EQ(id, 0);
    EXPECT_TRUE(driver.pictures.settled());
}

/// Of objects' colours [grey levels], root mean square, against samples without filter or history.
double errorOf(const RenderedPicture& picture, double azimuth) {
    Driver exact({Slicing::Time, 256, 16, 0, 16});
    exact.look(azimuth);
    exact.settle();
    const RenderedPicture& truth = exact.shown.back();
    double squares = 0;
    int values = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (truth.id[i] == 0 || truth.id[i] == kCatcherId) continue;
        for (std::size_t c = 0; c < 3; ++c)
            squares += std::pow(double(truth.colour[i][c]) - picture.colour[i][c], 2);
        values += 3;
    }
    EXPECT_GT(values, 300);
    return std::sqrt(squares / values);
}

TEST(ReferencePictures, AFirstPictureIsShownOfOneSampleInSixteenPixels) {
    Driver driver(kThirtyTwo, kProduct);
    driver.look(20);
    driver.untilShown(1);
    EXPECT_LT(driver.shown[0].samples, 0.15);
    driver.settle();
    EXPECT_GT(driver.shown.size(), 4U);
    const RenderedPicture &first = driver.shown.front(), &last = driver.shown.back();
    for (std::size_t i = 0; i < first.id.size(); ++i) {
        // Through a pixel's centre; later samples may find an object beside it.
        if (first.id[i] == 0 || first.id[i] == kCatcherId || last.id[i] == kCatcherId) continue;
        ASSERT_EQ(first.id[i], last.id[i]) << "objects are whole at once";
    }
    const auto objectsOf = [](const RenderedPicture& p) {
        return std::ranges::count_if(p.id, [](int id) { return id != 0 && id != kCatcherId; });
    };
    EXPECT_GT(objectsOf(first), 0.85 * static_cast<double>(objectsOf(last)));
    EXPECT_GT(errorOf(first, 20), errorOf(last, 20));
}

TEST(ReferencePictures, ANextPictureTakesOverTheLightOfTheOneBefore) {
    Driver fresh(kThirtyTwo, kProduct), going(kThirtyTwo, kProduct);
    fresh.look(26);
    fresh.untilShown(1);
    going.look(20);
    going.settle();
    const std::size_t before = going.shown.size();
    going.look(26);
    going.untilShown(before + 1);
    ASSERT_TRUE(going.shows(26));
    EXPECT_LT(going.shown.back().samples, 0.1);
    EXPECT_LT(errorOf(going.shown.back(), 26), 0.7 * errorOf(fresh.shown.back(), 26));
}

TEST(ReferencePictures, LightOfAnotherLightIsSoonOutweighed) {
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

TEST(ReferencePictures, SurfacesThatNothingChangesAreTracedOnce) {
    Driver driver({Slicing::Time, 2, 1, 0, 2}, kProduct);
    driver.size = {192, 144};
    // A black ball in the sun: it has a shadow, and changes no light elsewhere.
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
    EXPECT_GE(driver.pictures.pixels(), all) << "in new light any may be changed";
}

TEST(ReferencePictures, AtRestEachPixelHasItsOwnSamples) {
    Driver driver(kThirtyTwo, kProduct);
    driver.look(20);
    driver.settle();
    EXPECT_LT(driver.shown.back().samples, 32) << "of the real surface a quarter";
    for (int i = 0; i < 12; ++i)
        driver.look(20);
    driver.settle();
    EXPECT_EQ(driver.shown.back().samples, 32);
    EXPECT_TRUE(driver.pictures.settled());
}

}  // namespace
}  // namespace mfar
