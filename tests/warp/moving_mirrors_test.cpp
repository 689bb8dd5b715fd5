#include "pipeline/render/path_tracer.h"
#include "pipeline/render/picture_resolver.h"
#include "pipeline/simd/moving_mirrors.h"
#include "pipeline/simd/simd_warp.h"
#include "tests/render/render_scenes.h"
#include "tests/warp/mirror_surfaces.h"
#include "tests/warp/warp_support.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar::simd {
namespace {

using test::kMirrorPicture;
using test::mirrorCamera;
using test::MirrorSurfaces;
using test::smoothLight;

Eigen::Vector3f specularOf(const LightWords& words) {
    const auto rgb = unpackedWords(words).specular;
    return {rgb[0], rgb[1], rgb[2]};
}

struct Mirrors {
    AlignedRows<float> rayX{kMirrorPicture}, rayY{kMirrorPicture};
    MovingMirrors mirrors;

    explicit Mirrors(const TracedPicture& traced, int threads = 1)
        : mirrors(mirrorCamera(), rayX.rows(), rayY.rows(), std::make_shared<Workers>(threads)) {
        for (int y = 0; y < kMirrorPicture.height; ++y)
            for (int x = 0; x < kMirrorPicture.width; ++x) {
                const Eigen::Vector2d ray = mirrorCamera().unproject(Eigen::Vector2d(x, y));
                rayX[y][x] = static_cast<float>(ray.x());
                rayY[y][x] = static_cast<float>(ray.y());
            }
        mirrors.setTracedPicture(traced);
    }
};

const Eigen::Vector3d kMoved(0.35, 0.15, -0.2);

void expectNear(const Eigen::Vector3f& a, const Eigen::Vector3f& b, std::size_t i) {
    EXPECT_LT((a - b).lpNorm<Eigen::Infinity>(), 0.025F * b.lpNorm<Eigen::Infinity>())
        << "pixel " << i << ": " << a.transpose() << ", not " << b.transpose();
}

TEST(MovingMirrors, AfterACameraMotionMirrorsReflectTheSkyAsSeenFromTheNewPosition) {
    MirrorSurfaces s(smoothLight());
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation;
    // One third of the pixels reflect the sky, one third reflect half of its light, and one third
    // reflect a sky with more light.
    const auto shown = [&](std::size_t i, const Eigen::Vector3f& sky) -> Eigen::Vector3f {
        if (i % 3 == 0) return sky;
        return i % 3 == 1 ? Eigen::Vector3f(0.5F * sky)
                          : Eigen::Vector3f(sky + Eigen::Vector3f(1, 2, 3));
    };
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, shown(i, s.skyFor(eye, i)));
    Mirrors moving(s.traced);
    const Eigen::Vector3d other = eye + kMoved;
    const auto light = moving.mirrors.lightFor(other);
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        if (s.normals[i].dot(s.seenFrom(other, i)) < 0.05F) continue;
        expectNear(specularOf(light[i]), shown(i, s.skyFor(other, i)), i);
        EXPECT_EQ(light[i].diffuse, s.traced.light[i].diffuse);
        EXPECT_EQ(unpackedWords(light[i]).veil, unpackedWords(s.traced.light[i]).veil);
    }
}

TEST(MovingMirrors, AtThePositionOfTheTracedPictureMirrorsShowItsLight) {
    MirrorSurfaces s(smoothLight());
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation;
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, Eigen::Vector3f(0.3F, 2, 0.01F) * static_cast<float>(i % 5));
    Mirrors moving(s.traced);
    const auto before = moving.mirrors.lightFor(eye);
    EXPECT_TRUE(std::ranges::equal(before, s.traced.light));
    const LightWords moved = moving.mirrors.lightFor(eye + kMoved)[3];
    EXPECT_NE(moved, s.traced.light[3]);
    const auto back = moving.mirrors.lightFor(eye);
    for (std::size_t i = 0; i < s.points.size(); ++i)
        EXPECT_LT((specularOf(back[i]) - specularOf(s.traced.light[i])).lpNorm<Eigen::Infinity>(),
                  0.012F * specularOf(s.traced.light[i]).lpNorm<Eigen::Infinity>() + 0.002F)
            << i;
}

TEST(MovingMirrors, HighlightsOfTheSunMove) {
    MirrorSurfaces s(test::smoothLightAndSun());
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation;
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, s.skyAndSunFor(eye, i));
    Mirrors moving(s.traced);
    const Eigen::Vector3d other = eye + kMoved;
    const auto shown = moving.mirrors.lightFor(other);
    int bright = 0;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        // The roughness is stored in one byte, which is too coarse for the sharpest lobes.
        if (s.normals[i].dot(s.seenFrom(other, i)) < 0.05F || s.roughness[i] < 0.3F) continue;
        const Eigen::Vector3f truth = s.skyAndSunFor(other, i);
        bright += truth.norm() > 1.3F * s.skyFor(other, i).norm() ? 1 : 0;
        EXPECT_LT((specularOf(shown[i]) - truth).lpNorm<Eigen::Infinity>(),
                  0.06F * truth.lpNorm<Eigen::Infinity>())
            << i;
    }
    EXPECT_GT(bright, 10);
}

// Half of all light is hidden. Where the sun's light is weak, one visible share is computed for sky
// and sun together. The sun's light must then not be counted twice.
TEST(MovingMirrors, HalfHiddenSkyAndWeakSunStayHalfVisibleAfterAMotion) {
    MirrorLight light = test::smoothLightAndSun();
    light.sunIrradiance = {1.5F, 1.5F, 1.5F};
    MirrorSurfaces s(light);
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation, other = eye + kMoved;
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, 0.5F * s.skyAndSunFor(eye, i));
    Mirrors moving(s.traced);
    const auto shown = moving.mirrors.lightFor(other);
    const auto sunBySky = [&](const Eigen::Vector3d& from, std::size_t i) {
        return s.skyAndSunFor(from, i).mean() / s.skyFor(from, i).mean() - 1;
    };
    int weak = 0;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        if (s.normals[i].dot(s.seenFrom(other, i)) < 0.05F || s.roughness[i] < 0.3F) continue;
        const float before = sunBySky(eye, i), now = sunBySky(other, i);
        if (!(before > 0.04F && before < 0.08F && now < 0.08F)) continue;
        ++weak;
        expectNear(specularOf(shown[i]), 0.5F * s.skyAndSunFor(other, i), i);
    }
    EXPECT_GT(weak, 20);
}

TEST(MovingMirrors, ResultIsIndependentOfTheNumberOfThreads) {
    MirrorSurfaces s(smoothLight());
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, {1, 2, 3});
    Mirrors one(s.traced);
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation + kMoved;
    const auto alone = one.mirrors.lightFor(eye);
    for (int i = 0; i < 50; ++i) {
        Mirrors many(s.traced, 4);
        ASSERT_TRUE(std::ranges::equal(many.mirrors.lightFor(eye), alone)) << i;
    }
}

TEST(MovingMirrors, UnknownSurfacesKeepTheirLight) {
    MirrorSurfaces s(smoothLight());
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, {1, 2, 3});
    s.traced.gloss[4] = {};
    s.traced.packed[5] = 0;
    Mirrors moving(s.traced);
    const auto light = moving.mirrors.lightFor(kMoved);
    EXPECT_EQ(light[4], s.traced.light[4]);
    EXPECT_EQ(light[5], s.traced.light[5]);
    EXPECT_NE(light[6], s.traced.light[6]);
    s.traced.camera.fx *= 1.01;
    moving.mirrors.setTracedPicture(s.traced);
    EXPECT_EQ(moving.mirrors.lightFor(kMoved).data(), s.traced.light.data());
    s.traced.camera.fx /= 1.01;
    s.traced.gloss.clear();
    moving.mirrors.setTracedPicture(s.traced);
    EXPECT_EQ(moving.mirrors.lightFor(kMoved).data(), s.traced.light.data());
}

TEST(MovingMirrors, AWarpedMirrorBallIsNearerToTheTruthIfItsReflectionsMove) {
    using namespace render_scenes;
    Material metal;
    metal.roughness = 0.25F;
    auto scene = std::make_shared<Scene>();
    scene->objects.push_back(objectOf(modelOf(sphere({0, 0, 0}, 1, 64), metal)));
    scene->lighting = {unevenLight(), Sun{}};
    const PathTracer tracer(scene);
    const auto tracedFrom = [&](double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        const RenderView view =
            lookingAt({4 * std::sin(a), -4 * std::cos(a), 1}, {0, 0, 0}, {96, 72}, 130);
        RenderedPicture out;
        resolve(traced(tracer, view, 32), view, {0.3F}, out);
        out.mirrors = tracer.mirrorLight();
        return out;
    };
    const RenderedPicture from = tracedFrom(0), to = tracedFrom(8);
    const auto psnr = [&](const RenderedPicture& picture) {
        const auto warp = makeWarpStep(picture.camera, {}, nullptr, nullptr);
        const TracedPicture traced = tracedPicture(picture);
        warp->setScene(*scene);
        warp->setTracedPicture(traced);
        const Size size = picture.camera.size;
        LayerPicture& shown =
            warp->run({to.T_world_camera, {0, 0, size.width, size.height}, false});
        return test::psnrInside(test::bytesOf(shown.colour), to);
    };
    RenderedPicture still = from;
    still.gloss.clear();
    const double moves = psnr(from), sticks = psnr(still);
    EXPECT_GT(moves, sticks + 3);
    EXPECT_GT(moves, 30);
}

}  // namespace
}  // namespace mfar::simd
