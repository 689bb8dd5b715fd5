#include "pipeline/render/far_light.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/render/picture_resolver.h"
#include "pipeline/simd/moving_mirrors.h"
#include "pipeline/simd/simd_warp.h"
#include "tests/render/render_scenes.h"
#include "tests/warp/warp_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mfar::simd {
namespace {

constexpr Size kPicture{21, 40};
constexpr float kTwice = 2;  // light in the table of roughness 1, divided by that of roughness 0

CameraModel camera() {
    return {kPicture, 30, 30, 9.5, 18.5, {-0.1, 0.02, 0, 0, 0}};
}

Eigen::Vector3f lightFrom(const Eigen::Vector3f& direction) {
    return direction + Eigen::Vector3f::Constant(1.5F);
}

MirrorLight smoothLight() {
    MirrorLight out;
    for (const float roughness : {0.0F, 1.0F}) {
        const DirectionTable table(129);
        out.tables.push_back(
            {roughness, table.edge(), static_cast<std::uint32_t>(out.texels.size())});
        for (int row = 0; row < table.edge(); ++row)
            for (int column = 0; column < table.edge(); ++column) {
                const Eigen::Vector3f light =
                    (roughness > 0 ? kTwice : 1) * lightFrom(table.direction(column, row));
                out.texels.push_back(packedLight({light.x(), light.y(), light.z()}));
            }
    }
    return out;
}

struct Surfaces {
    std::vector<Eigen::Vector3f> points, normals;
    std::vector<float> roughness;
    TracedPicture traced;

    explicit Surfaces(const MirrorLight& mirrors) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> any(-1, 1);
        traced.camera = camera();
        traced.T_world_camera = {Eigen::Quaterniond(Eigen::AngleAxisd(
                                     2.1, Eigen::Vector3d(0.3, 0.8, -0.5).normalized())),
                                 {0.4, -0.2, 0.7}};
        traced.mirrors = std::make_shared<const MirrorLight>(mirrors);
        traced.exposure = 0.5F;
        traced.bounds = {0, 0, kPicture.width, kPicture.height};
        const Eigen::Matrix3f axes =
            traced.T_world_camera.rotation.toRotationMatrix().cast<float>();
        for (int y = 0; y < kPicture.height; ++y)
            for (int x = 0; x < kPicture.width; ++x) {
                const float z = std::bit_cast<float>(std::bit_cast<std::uint32_t>(2 + any(random)) &
                                                     0xFFFFFF00U);
                const Eigen::Vector3f ray =
                    axes * camera().unproject(Eigen::Vector2d(x, y)).homogeneous().cast<float>();
                Eigen::Vector3f n =
                    Eigen::Vector3f(any(random), any(random), any(random)).normalized();
                if (n.dot(ray) > 0) n = -n;
                n = (n - 0.7F * ray.normalized()).normalized();
                normals.push_back(n);
                points.push_back(traced.T_world_camera.translation.cast<float>() + z * ray);
                roughness.push_back(0.5F + 0.5F * any(random));
                traced.packed.push_back(std::bit_cast<std::uint32_t>(z) | 7U);
                traced.gloss.push_back(packedGloss({n.x(), n.y(), n.z()}, roughness.back(), 1, 1));
            }
        traced.light.resize(points.size());
    }
    [[nodiscard]] Eigen::Vector3f seenFrom(const Eigen::Vector3d& eye, std::size_t i) const {
        return (eye.cast<float>() - points[i]).normalized();
    }
    [[nodiscard]] Eigen::Vector3f skyFor(const Eigen::Vector3d& eye, std::size_t i) const {
        const Eigen::Vector3f wo = seenFrom(eye, i);
        const Eigen::Vector3f towards = 2 * normals[i].dot(wo) * normals[i] - wo;
        const float width = roughness[i] * roughness[i];
        return 0.5F * (1 + width * (kTwice - 1)) * lightFrom(towards);
    }
    void setLight(std::size_t i, const Eigen::Vector3f& specular) {
        traced.light[i] =
            packedWords({{0.1F, 0.2F, 0.3F}, {specular.x(), specular.y(), specular.z()}, 0.5F});
    }
};

Eigen::Vector3f specularOf(const LightWords& words) {
    const auto rgb = unpackedWords(words).specular;
    return {rgb[0], rgb[1], rgb[2]};
}

struct Mirrors {
    AlignedRows<float> rayX{kPicture}, rayY{kPicture};
    MovingMirrors mirrors;

    explicit Mirrors(const TracedPicture& traced, int threads = 1)
        : mirrors(camera(), rayX.rows(), rayY.rows(), std::make_shared<Workers>(threads)) {
        for (int y = 0; y < kPicture.height; ++y)
            for (int x = 0; x < kPicture.width; ++x) {
                const Eigen::Vector2d ray = camera().unproject(Eigen::Vector2d(x, y));
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
    Surfaces s(smoothLight());
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
    Surfaces s(smoothLight());
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
    MirrorLight light = smoothLight();
    const Eigen::Vector3f sun = Eigen::Vector3f(-0.2F, 0.4F, -0.9F).normalized();
    light.towardsSun = {sun.x(), sun.y(), sun.z()};
    light.sunIrradiance = {30, 30, 30};
    light.leastSunAlpha = 0.005F;
    Surfaces s(light);
    const Eigen::Vector3d eye = s.traced.T_world_camera.translation;
    const auto all = [&](const Eigen::Vector3d& from, std::size_t i) {
        const Eigen::Vector3f wo = s.seenFrom(from, i);
        const float o = s.normals[i].dot(wo), to = s.normals[i].dot(sun);
        Eigen::Vector3f out = s.skyFor(from, i);
        if (!(to > 0)) return out;
        const Eigen::Vector3f h = (wo + sun).normalized();
        const Ggx ggx(alphaOf(s.roughness[i]));
        const Eigen::Vector3f local = frameAround(s.normals[i]).transpose() * h;
        return Eigen::Vector3f(out.array() +
                               0.5F * 30 * ggx.density(local) * ggx.visibility(o, to) * to);
    };
    for (std::size_t i = 0; i < s.points.size(); ++i)
        s.setLight(i, all(eye, i));
    Mirrors moving(s.traced);
    const Eigen::Vector3d other = eye + kMoved;
    const auto shown = moving.mirrors.lightFor(other);
    int bright = 0;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        // The roughness is stored in one byte, which is too coarse for the sharpest lobes.
        if (s.normals[i].dot(s.seenFrom(other, i)) < 0.05F || s.roughness[i] < 0.3F) continue;
        const Eigen::Vector3f truth = all(other, i);
        bright += truth.norm() > 1.3F * s.skyFor(other, i).norm() ? 1 : 0;
        EXPECT_LT((specularOf(shown[i]) - truth).lpNorm<Eigen::Infinity>(),
                  0.06F * truth.lpNorm<Eigen::Infinity>())
            << i;
    }
    EXPECT_GT(bright, 10);
}

TEST(MovingMirrors, ResultIsIndependentOfTheNumberOfThreads) {
    Surfaces s(smoothLight());
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
    Surfaces s(smoothLight());
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
