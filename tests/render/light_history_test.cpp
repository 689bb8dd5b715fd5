#include "pipeline/render/light_history.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace mfar {
namespace {

constexpr Size kSeenSize{16, 12};

/// A camera that looks straight down onto the plane z = 0 from a height of 1 m.
const RenderView kFromAbove =
    render_scenes::lookingAt({0.0, -1e-6, 1.0}, {0, 0, 0}, kSeenSize, 100);

SeenSurface floorSurface(std::uint8_t id = kCatcherId) {
    SeenSurface out;
    out.hit = {1, id};
    out.normal = {0, 0, 1};
    return out;
}

/// The point of the plane that the camera sees at a pixel.
Eigen::Vector3f pointAt(double x, double y) {
    const Eigen::Vector3d ray = kFromAbove.camera.unproject({x, y}).homogeneous();
    return (kFromAbove.T_world_camera * ray).cast<float>();
}

/// Light of the shadow catcher at a pixel. Without objects it is 1 + x + 20 y, a linear function,
/// so that interpolation between pixels is exact.
KnownLight lightAt(int x, int y) {
    KnownLight out;
    out.first = Eigen::Vector3f::Constant(0.5F);
    out.second = Eigen::Vector3f::Constant(1 + static_cast<float>(x + 20 * y));
    out.firstCount = out.secondCount = 3;
    return out;
}

/// A film in which the pixels that `isSeen` selects show the plane.
Film filmOf(const std::function<bool(int, int)>& isSeen, std::uint8_t id = kCatcherId) {
    Film film(kSeenSize);
    for (int y = 0; y < kSeenSize.height; ++y)
        for (int x = 0; x < kSeenSize.width; ++x) {
            if (!isSeen(x, y)) continue;
            const auto pixel = static_cast<std::size_t>(y) * kSeenSize.width + x;
            film.setCentre(pixel, floorSurface(id));
            film.carry(pixel, lightAt(x, y));
        }
    return film;
}

bool isEven(int x, int y) {
    return x % 2 == 0 && y % 2 == 0;
}

KnownLight lightFrom(const Film& film, double x, double y,
                     const SeenSurface& surface = floorSurface()) {
    const LightHistory history(film, kFromAbove,
                               std::make_shared<const LensRays>(kFromAbove.camera), 64);
    return history.at(surface, pointAt(x, y), kFromAbove.T_world_camera.translation.cast<float>());
}

TEST(LightHistory, InterpolatesBetweenAdjacentPixelsWhereEveryPixelWasSampled) {
    // One pixel has another light. It must affect only points less than a pixel away.
    Film film = filmOf([](int, int) { return true; });
    KnownLight bright = lightAt(6, 4);
    bright.second *= 2;
    film.carry(4U * kSeenSize.width + 6, bright);
    const float plain = 1 + 7 + 20 * 4;
    EXPECT_NEAR(lightFrom(film, 7, 4).second.x(), plain, 0.1F);
    EXPECT_NEAR(lightFrom(film, 6.5, 4).second.x(), plain - 0.5F + 0.5F * (1 + 6 + 80), 0.2F);
}

TEST(LightHistory, InterpolatesOverTwoPixelsWhereAQuarterOfThePixelsWasSampled) {
    const Film film = filmOf(isEven);
    for (const auto& [x, y] : {std::pair{5.0, 4.0}, {5.0, 5.0}, {4.5, 7.25}, {9.75, 6.5}}) {
        const KnownLight light = lightFrom(film, x, y);
        EXPECT_NEAR(light.second.x(), 1 + x + 20 * y, 0.1) << x << ' ' << y;
        EXPECT_NEAR(light.first.x(), 0.5F, 1e-3F);
        EXPECT_NEAR(light.firstCount, 3, 1e-3F);
    }
}

TEST(LightHistory, AtTheLastColumnAndRowOfASparsePictureTheNearestPixelsSuffice) {
    const Film film = filmOf(isEven);
    EXPECT_NEAR(lightFrom(film, 15, 6).second.x(), 1 + 14 + 20 * 6, 0.1);
    EXPECT_NEAR(lightFrom(film, 8, 11).second.x(), 1 + 8 + 20 * 10, 0.1);
    EXPECT_EQ(lightFrom(film, 17.5, 6).firstCount, 0) << "the point is outside the picture";
}

TEST(LightHistory, BetweenSparselyAndFullySampledTilesTheSampledPixelsAreUsed) {
    // As in a sparse picture, tiles at objects (left) have light in all pixels, and other tiles
    // have light in a quarter of their pixels.
    const Film film = filmOf([](int x, int y) { return x < 8 || isEven(x, y); });
    for (const double x : {6.5, 7.0, 7.5, 8.0, 8.5, 9.0})
        EXPECT_NEAR(lightFrom(film, x, 5).second.x(), 1 + x + 20 * 5, x == 7.5 ? 0.6 : 0.1) << x;
}

TEST(LightHistory, ObjectsAreNeverInterpolatedOverTwoPixels) {
    const Film film = filmOf(isEven, 1);
    EXPECT_EQ(lightFrom(film, 5, 5, floorSurface(1)).firstCount, 0);
    EXPECT_GT(lightFrom(film, 4.5, 4.5, floorSurface(1)).firstCount, 0);
}

TEST(LightHistory, LightOfOtherSurfacesIsNotReused) {
    const Film film = filmOf(isEven);
    EXPECT_EQ(lightFrom(film, 5, 5, floorSurface(1)).firstCount, 0) << "another object";
    SeenSurface wall = floorSurface();
    wall.normal = {1, 0, 0};
    EXPECT_EQ(lightFrom(film, 5, 5, wall).firstCount, 0) << "another normal";
    const LightHistory history(film, kFromAbove,
                               std::make_shared<const LensRays>(kFromAbove.camera), 64);
    const Eigen::Vector3f eye = kFromAbove.T_world_camera.translation.cast<float>();
    const Eigen::Vector3f above = pointAt(5, 5) + Eigen::Vector3f(0, 0, 0.05F);
    EXPECT_EQ(history.at(floorSurface(), above, eye).firstCount, 0) << "another height";
}

}  // namespace
}  // namespace mfar
