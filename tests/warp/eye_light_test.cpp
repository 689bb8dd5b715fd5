#include "base/gl/validation.h"
#include "pipeline/gles/eye_light.h"
#include "pipeline/simd/moving_mirrors.h"
#include "tests/engine/gl_test.h"
#include "tests/warp/mirror_surfaces.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using EyeLightGl = GlTest;
using test::kMirrorPicture;

std::vector<LightWords> simdLight(const TracedPicture& traced, const Eigen::Vector3d& eye) {
    AlignedRows<float> rayX(kMirrorPicture), rayY(kMirrorPicture);
    for (int y = 0; y < kMirrorPicture.height; ++y)
        for (int x = 0; x < kMirrorPicture.width; ++x) {
            const Eigen::Vector2d ray = test::mirrorCamera().unproject(Eigen::Vector2d(x, y));
            rayX[y][x] = static_cast<float>(ray.x());
            rayY[y][x] = static_cast<float>(ray.y());
        }
    simd::MovingMirrors mirrors(test::mirrorCamera(), rayX.rows(), rayY.rows(), nullptr);
    mirrors.setTracedPicture(traced);
    const auto light = mirrors.lightFor(eye);
    return {light.begin(), light.end()};
}

TracedPicture uploadable(TracedPicture traced) {
    const std::size_t pixels = traced.packed.size();
    traced.picture.resize(pixels);
    traced.colour.resize(pixels);
    traced.depth.resize(pixels);
    traced.surface.resize(pixels);
    return traced;
}

struct OfGles {
    explicit OfGles(TracedPicture picture)
        : traced(uploadable(std::move(picture))), light(test::mirrorCamera()) {
        textures.upload(traced);
        light.setTracedPicture(traced, textures);
    }
    TracedPicture traced;
    TracedTextures textures;
    EyeLight light;
    gpu::Texture rays = rayTexture(test::mirrorCamera());
};

/// Rounding to light words changes a value by up to 1/256 of the pixel's largest channel, rounding
/// to half floats by less.
void expectNear(const std::vector<float>& texels, std::size_t pixel, std::array<float, 3> wanted) {
    const float most = *std::ranges::max_element(wanted);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(texels[4 * pixel + c], wanted[c], 0.012F * most + 1e-3F)
            << "pixel " << pixel << ", channel " << c;
}

// One third of the pixels reflect the sky, one third reflect half of its light, and one third
// reflect a sky with more light.
TEST_F(EyeLightGl, MovesMirroredLightAsTheSimdEngineDoes) {
    test::MirrorSurfaces s(test::smoothLight());
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        const Eigen::Vector3f sky = s.skyFor(eye, i);
        s.setLight(i, i % 3 == 0   ? sky
                      : i % 3 == 1 ? Eigen::Vector3f(0.5F * sky)
                                   : Eigen::Vector3f(sky + Eigen::Vector3f(1, 2, 3)));
    }
    s.traced.gloss[5] = {};
    OfGles gles(s.traced);
    for (const Eigen::Vector3d& to :
         {Eigen::Vector3d(eye), Eigen::Vector3d(eye + Eigen::Vector3d(0.35, 0.15, -0.2))}) {
        gles.light.run(to, gles.rays);
        const std::vector<float> diffuse = gles.light.diffuse().readRgba32F();
        const std::vector<float> specular = gles.light.specular().readRgba32F();
        const std::vector<LightWords> simd = simdLight(s.traced, to);
        for (std::size_t i = 0; i < simd.size(); ++i) {
            const UnpackedLight wanted = unpackedWords(simd[i]);
            expectNear(diffuse, i, wanted.diffuse);
            expectNear(specular, i, wanted.specular);
            EXPECT_NEAR(specular[4 * i + 3], wanted.veil, 1e-3F);
        }
    }
}

TEST_F(EyeLightGl, HighlightsOfTheSunMove) {
    test::MirrorSurfaces s(test::smoothLightAndSun());
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation;
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, s.skyAndSunFor(eye, i));
    OfGles gles(s.traced);
    const Eigen::Vector3d other = eye + Eigen::Vector3d(0.35, 0.15, -0.2);
    gles.light.run(other, gles.rays);
    const std::vector<float> specular = gles.light.specular().readRgba32F();
    int bright = 0;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        // The roughness is stored in one byte, which is too coarse for the sharpest lobes.
        if (s.normals[i].dot(s.seenFrom(other, i)) < 0.05F || s.roughness[i] < 0.3F) continue;
        const Eigen::Vector3f truth = s.skyAndSunFor(other, i);
        bright += truth.norm() > 1.3F * s.skyFor(other, i).norm() ? 1 : 0;
        const Eigen::Vector3f shown(specular[4 * i], specular[4 * i + 1], specular[4 * i + 2]);
        EXPECT_LT((shown - truth).lpNorm<Eigen::Infinity>(),
                  0.06F * truth.lpNorm<Eigen::Infinity>())
            << i;
    }
    EXPECT_GT(bright, 10);
}

TEST_F(EyeLightGl, WithoutGlossOrWithAnotherCameraTheLightStays) {
    test::MirrorSurfaces s(test::smoothLightAndSun());
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, {0.1F * static_cast<float>(i % 7), 0.3F, 2});
    TracedPicture without = s.traced, other = s.traced;
    without.gloss.clear();
    other.camera.fx *= 1.01;
    for (const TracedPicture& traced : {without, other}) {
        OfGles gles(traced);
        gles.light.run({1, 2, 3}, gles.rays);
        const std::vector<float> specular = gles.light.specular().readRgba32F();
        for (std::size_t i = 0; i < s.points.size(); ++i)
            expectNear(specular, i, unpackedWords(traced.light[i]).specular);
    }
}

// The test overwrites the result. A pass that runs again would restore it.
TEST_F(EyeLightGl, RunsOncePerPictureIfTheLightCannotChange) {
    test::MirrorSurfaces s(test::smoothLight());
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, {1, 2, 3});
    for (const bool moves : {true, false}) {
        if (!moves) s.traced.gloss.clear();
        OfGles gles(s.traced);
        const auto redAt = [&](const Eigen::Vector3d& eye) {
            gles.light.run(eye, gles.rays);
            return gles.light.specular().readRgba32F().front();
        };
        EXPECT_NE(redAt({1, 2, 3}), 0);
        const gpu::Framebuffer overwritten(gles.light.specular());
        overwritten.bind();
        constexpr std::array<GLfloat, 4> kDark{};
        glClearBufferfv(GL_COLOR, 0, kDark.data());
        EXPECT_EQ(redAt({1, 2, 3}), 0) << "the eye is the same";
        EXPECT_EQ(redAt({3, 2, 1}) != 0, moves);
        gles.light.setTracedPicture(gles.traced, gles.textures);
        EXPECT_NE(redAt({3, 2, 1}), 0) << "the picture is new";
    }
}

// Look-ups next to the bounds multiply the light outside by 0. If it were NaN, the sum would be
// NaN.
TEST_F(EyeLightGl, LightOutsideTheBoundsOfAllSurfacesIsZero) {
    test::MirrorSurfaces s(test::smoothLight());
    s.traced.bounds = {8, 16, 16, 32};
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, {1, 2, 3});
    std::optional<gpu::Validation> nanInNewTextures(std::in_place);
    OfGles gles(s.traced);
    nanInNewTextures.reset();
    gles.light.run({1, 2, 3}, gles.rays);
    for (const gpu::Texture* light : {&gles.light.diffuse(), &gles.light.specular()}) {
        const std::vector<float> texels = light->readRgba32F();
        for (int y = 0; y < kMirrorPicture.height; ++y)
            for (int x = 0; x < kMirrorPicture.width; ++x) {
                const bool outside = common(s.traced.bounds, {x, y, x + 1, y + 1}).empty();
                const float red = texels[4UL * (y * kMirrorPicture.width + x)];
                EXPECT_EQ(red == 0, outside) << red << " in pixel " << x << ", " << y;
            }
    }
}

}  // namespace
}  // namespace mfar
