#include "base/luminance.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace mfar {
namespace {

constexpr Size kSmall{24, 18};
constexpr int kFiner = 9;  // odd, so that a finer pixel has the same centre as a pixel
constexpr float kRoughness = 0.3F;

/// Metal balls side by side on z = 0.
std::shared_ptr<const Scene> balls(float radius, float brightness) {
    Material metal;
    metal.roughness = kRoughness;
    Model model;
    model.materials.push_back(metal);
    const int side = static_cast<int>(1 / (2 * radius));
    for (int y = -side; y <= side; ++y)
        for (int x = -side; x <= side; ++x)
            model.meshes.push_back(render_scenes::sphere(
                {2 * radius * static_cast<float>(x), 2 * radius * static_cast<float>(y), 0}, radius,
                8));
    auto environment = std::make_shared<Environment>(*render_scenes::unevenLight());
    for (Eigen::Vector3f& radiance : environment->radiance)
        radiance *= brightness;
    auto scene = std::make_shared<Scene>();
    scene->objects.push_back(render_scenes::objectOf(std::move(model)));
    scene->lighting.environment = environment;
    return scene;
}

/// A view in which 1 m at the balls is 15 pixels wide.
RenderView viewOf(Size size) {
    RenderView view = render_scenes::lookingAt({0, -1, 1.7}, {0, 0, 0}, kSmall, 30);
    view.camera = view.camera.scaledTo(size);
    return view;
}

Film seen(const std::shared_ptr<const Scene>& scene, Size size) {
    return render_scenes::traced(PathTracer(scene), viewOf(size), 0);
}

std::size_t placeOf(int x, int y, Size size) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
           static_cast<std::size_t>(x);
}

/// Mean of the light that the points of a pixel mirror to the eye, divided by their mean paint.
Eigen::Vector3f meanMirrored(const Film& finer, int x, int y, std::uint8_t id) {
    Eigen::Vector3f sum{0, 0, 0};
    float weights = 0;
    for (int j = 0; j < kFiner; ++j)
        for (int i = 0; i < kFiner; ++i) {
            const SeenSurface& point =
                finer.centre(placeOf(kFiner * x + i, kFiner * y + j, finer.size()));
            if (point.hit.id != id) continue;
            const float weight = luminanceOf<float>(point.paint.specular());
            sum += weight * point.far.specular;
            weights += weight;
        }
    return sum / weights;
}

TEST(PixelSurface, MirroredLightOfSmallBallsIsTheMeanOverThePixel) {
    const auto scene = balls(0.1F, 1);  // a ball is three pixels wide
    const Film film = seen(scene, kSmall),
               finer = seen(scene, {kFiner * kSmall.width, kFiner * kSmall.height});
    double ofPixel = 0, ofPoint = 0;
    int count = 0;
    for (int y = 0; y < kSmall.height; ++y)
        for (int x = 0; x < kSmall.width; ++x) {
            const SeenSurface& pixel = film.centre(placeOf(x, y, kSmall));
            if (pixel.hit.id == 0) continue;
            const SeenSurface& point = finer.centre(
                placeOf(kFiner * x + kFiner / 2, kFiner * y + kFiner / 2, finer.size()));
            EXPECT_FLOAT_EQ(point.roughness, kRoughness) << "a finer pixel must show one point";
            const Eigen::Vector3f mean = meanMirrored(finer, x, y, pixel.hit.id);
            ofPixel += (pixel.far.specular - mean).squaredNorm();
            ofPoint += (point.far.specular - mean).squaredNorm();
            ++count;
        }
    ASSERT_GT(count, 200);
    // Without the mean, both errors would be about equal.
    EXPECT_LT(std::sqrt(ofPixel), 0.4 * std::sqrt(ofPoint));
}

TEST(PixelSurface, PixelsOfSmallBallsAreRougherThanTheMaterialAndThoseOfLargeBallsAreNot) {
    for (const auto& [radius, isRough] : {std::pair(0.1F, true), std::pair(1.0F, false)}) {
        const Film film = seen(balls(radius, 1), kSmall);
        const SeenSurface& middle =
            film.centre(placeOf(kSmall.width / 2, kSmall.height / 2, kSmall));
        ASSERT_NE(middle.hit.id, 0);
        EXPECT_NEAR(middle.normal.norm(), 1, 1e-5);
        if (isRough)
            EXPECT_GT(middle.roughness, kRoughness + 0.05F);
        else
            EXPECT_FLOAT_EQ(middle.roughness, kRoughness);
    }
}

// If the light that the points of a pixel mirror differs by more than a limit, the pixel gets more
// points. The limit is proportional to the brightness of the environment. A fixed limit would give
// dim and bright scenes different numbers of points.
TEST(PixelSurface, LightIsProportionalToTheBrightnessOfTheEnvironment) {
    const Film dim = seen(balls(0.1F, 0.05F), kSmall), bright = seen(balls(0.1F, 1), kSmall);
    for (std::size_t i = 0; i < render_scenes::allPixels(kSmall).size(); ++i) {
        const Eigen::Vector3f expected = 0.05F * bright.centre(i).far.specular;
        if (bright.centre(i).hit.id == 0) continue;
        EXPECT_LT((dim.centre(i).far.specular - expected).norm(), 1e-3F * expected.norm()) << i;
    }
}

}  // namespace
}  // namespace mfar
