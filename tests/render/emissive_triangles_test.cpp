#include "pipeline/render/emissive_triangles.h"
#include "pipeline/render/sobol.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mfar {
namespace {

using namespace render_scenes;

constexpr float kPi = std::numbers::pi_v<float>;

std::shared_ptr<const Scene> sceneOf(Model model) {
    auto out = std::make_shared<Scene>();
    out->objects.push_back(objectOf(std::move(model)));
    return out;
}

EmissiveTriangles::Sample sampleOf(const EmissiveTriangles& emitters, const Eigen::Vector3f& from,
                                   std::uint32_t number) {
    const PixelSampler sampler(1, 2, number, false);
    return emitters.sample(from, sampler.pair(0), sampler.pair(1).x());
}

TEST(EmissiveTriangles, MeanInverseDensityIsTheSolidAngleOfTheTriangles) {
    const TracedScene scene(sceneOf(modelOf(square(1, 0), lampOf({1, 1, 1}))), 1);
    const EmissiveTriangles emitters(scene);
    ASSERT_FALSE(emitters.dark());
    for (const float height : {0.5F, 3.0F}) {
        // Solid angle of a square of half side 1 seen from `height` above its centre.
        const float solid = 4 * std::asin(1 / (1 + height * height));
        double sum = 0;
        constexpr std::uint32_t kCount = 4096;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const auto sample = sampleOf(emitters, {0, 0, height}, i);
            ASSERT_GT(sample.density, 0);
            EXPECT_NEAR(sample.ray.direction.norm(), 1, 1e-6F);
            sum += 1 / static_cast<double>(sample.density) / kCount;
        }
        EXPECT_NEAR(sum / solid, 1, 0.001) << height;
    }
}

TEST(EmissiveTriangles, DensityOfARayEqualsTheDensityOfItsSample) {
    for (const bool doubleSided : {false, true}) {
        Model model = modelOf(sphere({0, 0, 0}, 0.5F, 12), lampOf({1, 2, 3}));
        model.materials[0].doubleSided = doubleSided;
        const TracedScene scene(sceneOf(std::move(model)), 1);
        const EmissiveTriangles emitters(scene);
        int seen = 0, sampled = 0;
        for (std::uint32_t i = 0; i < 1000; ++i) {
            const auto sample = sampleOf(emitters, {0.3F, -1, 0.7F}, i);
            if (!(sample.density > 0)) continue;
            ++sampled;
            const RayHit hit = scene.objects().first(sample.ray);
            ASSERT_TRUE(hit.found());
            if (hit.mesh != sample.point.mesh || hit.triangle != sample.point.triangle) continue;
            ++seen;
            EXPECT_NEAR(emitters.density(sample.ray, hit) / sample.density, 1, 1e-3F);
        }
        // Less than half of the sphere faces the point. The rest is sampled only if double-sided.
        EXPECT_NEAR(seen, 320, 30);
        EXPECT_NEAR(sampled, doubleSided ? 1000 : seen, 2);
    }
}

TEST(EmissiveTriangles, ProbabilityIsProportionalToPower) {
    // Three squares emit: areas 4, 4 and 16, luminances 1, 3 and 0.2126.
    Model model;
    model.materials = {lampOf({1, 1, 1}), lampOf({3, 3, 3}), lampOf({1, 0, 0}), Material{}};
    for (int i = 0; i < 4; ++i) {
        model.meshes.push_back(square(i == 2 ? 2 : 1, static_cast<float>(i)));
        model.meshes.back().material = i;
    }
    const TracedScene scene(sceneOf(std::move(model)), 1);
    const EmissiveTriangles emitters(scene);
    std::array<int, 4> drawn{};
    constexpr int kCount = 16384;
    for (std::uint32_t i = 0; i < kCount; ++i)
        ++drawn.at(sampleOf(emitters, {0, 0, 9}, i).point.mesh);
    const std::array<float, 4> power = {4, 12, 16 * 0.2126F, 0};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(static_cast<float>(drawn[i]) / kCount, power[i] / (16 + power[2]), 0.003F) << i;
}

TEST(EmissiveTriangles, PowerOfATexturedTriangleFollowsFromItsMeanTexel) {
    // The left square shows only the texture's white texel, the right one only a black texel.
    Material lamp = lampOf({1, 1, 1});
    lamp.emissionTexture = 0;
    Model model;
    model.materials = {lamp};
    model.textures = {
        {{4, 1}, false, {{255, 255, 255, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}, {0, 0, 0, 255}}}};
    for (const float u : {0.125F, 0.625F}) {
        Mesh mesh = square(1, 0);
        for (auto& p : mesh.positions)
            p.x() += 10 * u;
        mesh.uvs.assign(4, {u, 0.5F});
        model.meshes.push_back(mesh);
    }
    // The third square shows the whole texture. Only a quarter of it is white, so that the square
    // has a quarter of the first square's power.
    model.meshes.push_back(square(1, 0));
    const TracedScene scene(sceneOf(std::move(model)), 1);
    const EmissiveTriangles emitters(scene);
    std::array<int, 3> drawn{};
    for (std::uint32_t i = 0; i < 32768; ++i)
        ++drawn.at(sampleOf(emitters, {0, 0, 9}, i).point.mesh);
    EXPECT_EQ(drawn[1], 0);
    EXPECT_NEAR(static_cast<float>(drawn[2]) / static_cast<float>(drawn[0]), 0.25F, 0.02F);
}

TEST(EmissiveTriangles, TrianglesWithoutAreaOrEmissionAreNotSampled) {
    Mesh mesh = square(1, 0);
    mesh.positions.push_back({0, 0, 0});
    mesh.triangles.push_back({4, 4, 4});
    mesh.triangles.push_back({0, 4, 2});
    Model model = modelOf(mesh, lampOf({1, 1, 1}));
    const TracedScene scene(sceneOf(model), 1);
    const EmissiveTriangles emitters(scene);
    for (std::uint32_t i = 0; i < 1000; ++i)
        EXPECT_LT(sampleOf(emitters, {0, 0, 1}, i).point.triangle, 2U);
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
    const TracedScene flat(sceneOf(modelOf(mesh, lampOf({1, 1, 1}))), 1);
    EXPECT_TRUE(EmissiveTriangles(flat).dark());
    const TracedScene black(sceneOf(modelOf(square(1, 0), {})), 1);
    EXPECT_TRUE(EmissiveTriangles(black).dark());
}

TEST(EmissiveTriangles, TrianglesAreNotSampledFromAPointOnTheirPlane) {
    const TracedScene scene(sceneOf(modelOf(square(1, 0), lampOf({1, 1, 1}))), 1);
    const EmissiveTriangles emitters(scene);
    for (const Eigen::Vector3f& from :
         {Eigen::Vector3f(3, 0, 0), Eigen::Vector3f(0.2F, 0.1F, 0), Eigen::Vector3f(1, 1, 0)})
        for (std::uint32_t i = 0; i < 100; ++i)
            EXPECT_EQ(sampleOf(emitters, from, i).density, 0);
}

TEST(EmissiveTriangles, BrightTinyAndFaintTrianglesHaveFiniteDensities) {
    for (const float side : {1e-18F, 1e-6F, 1e3F, 1e15F})
        for (const float emission : {1e-38F, 1e-6F, 1e38F}) {
            const TracedScene scene(
                sceneOf(modelOf(square(side, 1), lampOf(Eigen::Vector3f::Constant(emission)))), 1);
            const EmissiveTriangles emitters(scene);
            if (emitters.dark()) continue;
            for (std::uint32_t i = 0; i < 50; ++i) {
                const auto sample = sampleOf(emitters, {0, 0, 0}, i);
                EXPECT_TRUE(std::isfinite(sample.density) && sample.density >= 0);
            }
        }
}

}  // namespace
}  // namespace mfar
