#include "pipeline/render/environment_light.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/render/surface_scatter.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <stdexcept>

namespace mfar {
namespace {

using namespace render_scenes;

Material materialOf(const Eigen::Vector3f& colour, float metallic, float roughness) {
    Material out;
    out.baseColour << colour, 1;
    out.metallic = metallic;
    out.roughness = roughness;
    return out;
}

std::shared_ptr<Scene> sceneOf(Mesh mesh, const Material& material) {
    auto out = std::make_shared<Scene>();
    out->objects.push_back(objectOf(modelOf(std::move(mesh), material)));
    return out;
}

Eigen::Vector3f meanRadiance(const Film& film) {
    Eigen::Vector3f sum{0, 0, 0};
    int pixels = 0;
    for (const std::uint32_t p : allPixels(film.size())) {
        if (film.means(p).objectShare < 1) continue;
        sum += film.means(p).object;
        ++pixels;
    }
    EXPECT_GT(pixels, 0);
    return sum / static_cast<float>(pixels);
}

Mesh flatSquare() {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

// A pixel covers two bumps of the normal map. If it covered three, the bumps would be as far apart
// as the points at which a pixel's normals are computed, and all these normals would be equal.
TEST(PathTracer, FineNormalMapGivesTheMeanNormalAndARaisedRoughness) {
    const auto seen = [](bool bumpy) {
        Material material = materialOf({0.9F, 0.9F, 0.9F}, 1, 0.2F);
        Model model = modelOf(flatSquare(), material);
        model.textures.push_back({{4, 1}, false, {}});
        for (const std::uint8_t x : {50, 128, 205, 128})
            model.textures.back().texels.push_back({x, 128, 230, 255});
        if (bumpy) model.materials.front().normalTexture = 0;
        auto scene = std::make_shared<Scene>();
        scene->objects.push_back(objectOf(std::move(model)));
        // The light is uneven, so that the bumps mirror different light.
        scene->lighting.environment = unevenLight();
        const RenderView view = lookingAt({0, 0, 4}, {0, 0, 0}, {16, 16}, 20);
        // The rays through the pixels' centres suffice: they come before the first sample.
        const Film film = traced(PathTracer(scene), view, 0);
        return std::pair(film.centre(8 * 16 + 8), film.gloss(8 * 16 + 8));
    };
    const auto [flat, flatGloss] = seen(false);
    const auto [bumpy, bumpyGloss] = seen(true);
    EXPECT_NEAR(flat.roughness, 0.2F, 0.01F);
    EXPECT_GT(flat.normal.z(), 0.999F);
    EXPECT_GT(bumpy.roughness, 0.3F);
    EXPECT_NEAR(bumpy.normal.norm(), 1, 1e-4F);
    EXPECT_GT(bumpy.normal.z(), 0.85F);
    EXPECT_EQ(flatGloss.look & 0xFFU, 51U);
    EXPECT_GT(bumpyGloss.look & 0xFFU, 76U);
}

TEST(PathTracer, WhiteSphereLooksLikeTheUniformLightAroundIt) {
    for (const float metallic : {0.0F, 1.0F})
        for (const float roughness : {0.2F, 0.6F, 1.0F}) {
            auto scene =
                sceneOf(sphere({0, 0, 0}, 1, 64), materialOf({1, 1, 1}, metallic, roughness));
            scene->lighting.environment = evenLight(0.7F);
            const RenderView view = lookingAt({0, -4, 0}, {0, 0, 0}, {16, 16}, 30);
            const Film film = traced(PathTracer(scene), view, 64);
            EXPECT_NEAR(meanRadiance(film).mean(), 0.7F, 0.012F) << metallic << ' ' << roughness;
            EXPECT_EQ(film.dropped(), 0U);
        }
}

TEST(PathTracer, WhiteBowlReflectsAllLightThatItReceives) {
    // Light is reflected many times inside. All of it must leave, except for paths beyond the
    // length limit.
    Mesh bowl = sphere({0, 0, 0}, 1, 32);
    std::erase_if(bowl.triangles, [&](const auto& t) {
        return bowl.positions[t[0]].z() > 0.3F || bowl.positions[t[1]].z() > 0.3F;
    });
    Material white = materialOf({1, 1, 1}, 0, 0.5F);
    white.doubleSided = true;
    auto scene = sceneOf(bowl, white);
    scene->lighting.environment = evenLight(1);
    const RenderView view = lookingAt({0, -1.0, 4}, {0, 0, -0.5}, {16, 16}, 40);
    PathTracerOptions options;
    options.maxDepth = 40;
    const float deep = meanRadiance(traced(PathTracer(scene, options), view, 64)).mean();
    EXPECT_NEAR(deep, 1, 0.02F);
    options.maxDepth = 2;
    EXPECT_LT(meanRadiance(traced(PathTracer(scene, options), view, 16)).mean(), deep);
}

TEST(PathTracer, RussianRouletteDoesNotChangeTheMeanRadiance) {
    auto scene = sceneOf(sphere({0, 0, 0}, 1, 16), materialOf({0.8F, 0.8F, 0.8F}, 0, 1));
    scene->catcher = ground(3, 0.8F);
    for (Eigen::Vector3f& p : scene->catcher.positions)
        p.z() = -1;
    scene->lighting.environment = evenLight(1);
    const RenderView view = lookingAt({0, -4, 0}, {0, 0, 0}, {24, 24}, 44);
    PathTracerOptions early, late;
    early.rouletteDepth = 1;
    late.rouletteDepth = 64;
    early.maxDepth = late.maxDepth = 10;
    const float a = meanRadiance(traced(PathTracer(scene, early), view, 64)).mean();
    const float b = meanRadiance(traced(PathTracer(scene, late), view, 64)).mean();
    EXPECT_NEAR(a, b, 0.006F);
}

/// Radiance of a horizontal surface towards `wo`, by quadrature over the environment, without sun.
Eigen::Vector3f byQuadrature(const Lighting& lighting, const SurfaceLook& look,
                             const Eigen::Vector3f& wo) {
    const SurfaceScatter scatter(look, wo);
    const EnvironmentLight environment(lighting.environment);
    Eigen::Vector3f sum{0, 0, 0};
    constexpr int kHeights = 512, kPhis = 1024;
    for (int i = 0; i < kHeights; ++i)
        for (int j = 0; j < kPhis; ++j) {
            const float z = (static_cast<float>(i) + 0.5F) / kHeights;
            const float phi =
                2 * std::numbers::pi_v<float> * (static_cast<float>(j) + 0.5F) / kPhis;
            const float r = std::sqrt(1 - z * z);
            const Eigen::Vector3f wi{r * std::cos(phi), r * std::sin(phi), z};
            sum += scatter.evaluate(wi).value.cwiseProduct(environment.radiance(wi));
        }
    return sum * (2 * std::numbers::pi_v<float> / kHeights / kPhis);
}

TEST(PathTracer, EnvironmentLightOnASurfaceMatchesTheIntegral) {
    for (const float roughness : {0.25F, 0.5F, 1.0F}) {
        auto scene = sceneOf(square(1, 0), materialOf({0.9F, 0.6F, 0.3F}, 0.6F, roughness));
        scene->lighting.environment = unevenLight();
        const RenderView view = lookingAt({0, -3, 2}, {0, 0, 0}, {4, 4}, 2000);
        const Eigen::Vector3f seen = meanRadiance(traced(PathTracer(scene), view, 1024));
        const Eigen::Vector3f expected =
            byQuadrature(scene->lighting, {{0.9F, 0.6F, 0.3F}, 0.6F, roughness, false},
                         Eigen::Vector3f(0, -3, 2).normalized());
        EXPECT_NEAR((seen - expected).norm() / expected.norm(), 0, 0.015F) << roughness;
    }
}

TEST(PathTracer, SunlightOnAMattSurfaceIsIrradianceTimesCosine) {
    auto scene = std::make_shared<Scene>();
    scene->objects.push_back(objectOf(modelOf(sphere({50, 50, 0}, 0.1F, 8), {})));
    scene->catcher = ground(1, 0.6F);
    scene->lighting.sun = Sun{Eigen::Vector3f(1, 0, 1).normalized(), {3, 2, 1}, 0.05F};
    const RenderView view = lookingAt({0, -3, 2}, {0, 0, 0}, {2, 2}, 500);
    const Film film = traced(PathTracer(scene), view, 64);
    const Eigen::Vector3f expected =
        scene->lighting.sun->irradiance * (0.6F * std::numbers::inv_pi_v<float> * std::sqrt(0.5F));
    for (const std::uint32_t p : allPixels(film.size())) {
        EXPECT_NEAR((film.means(p).without - expected).norm(), 0, 0.002F);
        EXPECT_EQ(film.means(p).with, film.means(p).without);
    }
}

TEST(PathTracer, MirrorShowsTheSunWithItsRadiance) {
    // The sun's disc fills the reflection lobe. Some rays are sampled from the disc, others from
    // the lobe. Only the weighted sum of both gives the sun's radiance.
    auto scene = sceneOf(square(1, 0), materialOf({1, 1, 1}, 1, 0.1F));
    scene->lighting.sun = Sun{Eigen::Vector3f(0, 1, 1).normalized(), {2, 2, 2}, 0.4F};
    const RenderView view = lookingAt({0, -3, 3}, {0, 0, 0}, {4, 4}, 2000);
    const float seen = meanRadiance(traced(PathTracer(scene), view, 256)).mean();
    const float sine = std::sin(0.4F);
    EXPECT_NEAR(seen * std::numbers::pi_v<float> * sine * sine, 2, 0.04F);
}

TEST(PathTracer, EmissiveSurfacesAreVisibleAndGiveLight) {
    Material lamp = materialOf({0, 0, 0}, 0, 1);
    lamp.emission = {2, 1, 0.5F};
    auto scene = sceneOf(sphere({0, 0, 0}, 1, 24), lamp);
    const RenderView view = lookingAt({0, -4, 0}, {0, 0, 0}, {8, 8}, 20);
    const Eigen::Vector3f seen = meanRadiance(traced(PathTracer(scene), view, 4));
    EXPECT_NEAR((seen - lamp.emission).norm(), 0, 1e-5F);
    // A sphere of radius r = 1 at height h = 2 adds radiance * albedo * (r / h)^2 to the ground
    // below.
    scene->catcher = ground(20, 0.5F);
    for (Eigen::Vector3f& p : scene->catcher.positions)
        p.z() = -2;
    const RenderView below = lookingAt({0.01, 0, -1.5}, {0, 0, -2}, {4, 4}, 1000);
    const Film film = traced(PathTracer(scene), below, 1024);
    EXPECT_NEAR(film.means(5).with.x(), 2 * 0.5F / 4, 0.01F);
    EXPECT_EQ(film.means(5).without.x(), 0);
}

TEST(PathTracer, TexturesAlphaMasksAndSingleSidedMaterialsAffectThePicture) {
    auto texture = SurfaceTexture{{2, 1}, false, {{255, 0, 0, 255}, {0, 255, 0, 0}}};
    Material masked = materialOf({1, 1, 1}, 0, 1);
    masked.baseColourTexture = 0;
    masked.alphaCutoff = 0.5F;
    Model model = modelOf(square(1, 0), masked);
    model.textures.push_back(texture);
    auto scene = std::make_shared<Scene>();
    scene->objects.push_back(objectOf(model));
    scene->lighting.environment = evenLight(1);
    const RenderView above = lookingAt({0, 0, 4}, {0, 0, 0}, {16, 16}, 31);
    const RenderedPicture picture = resolved(traced(PathTracer(scene), above, 4), above);
    int left = 0, right = 0;
    for (std::size_t i = 0; i < picture.id.size(); ++i)
        (i % 16 < 8 ? left : right) += picture.id[i];
    EXPECT_GT(std::max(left, right), 40);
    EXPECT_EQ(std::min(left, right), 0);
    const std::size_t solid = left > right ? 8 * 16 + 4 : 8 * 16 + 11;
    EXPECT_GT(picture.colour[solid][0], 200);
    EXPECT_LT(picture.colour[solid][1], 100);

    const RenderView under = lookingAt({0, 0, -4}, {0, 0, 0}, {16, 16}, 31);
    EXPECT_EQ(resolved(traced(PathTracer(scene), under, 2), under).samples, 0);
    model.materials[0].doubleSided = true;
    scene->objects[0] = objectOf(model);
    EXPECT_GT(resolved(traced(PathTracer(scene), under, 2), under).samples, 0);
}

TEST(PathTracer, NormalsTiltedTowardsTheSunBrightenTheSurface) {
    // All normals are tilted towards +u, which is +x.
    SurfaceTexture map{{1, 1}, false, {{218, 128, 218, 255}}};
    Material leaning = materialOf({1, 1, 1}, 0, 1);
    leaning.normalTexture = 0;
    Model model = modelOf(square(1, 0), leaning);
    model.textures.push_back(map);
    const auto brightness = [&](float x, const Model& shown) {
        auto scene = std::make_shared<Scene>();
        scene->objects.push_back(objectOf(shown));
        scene->lighting.sun = Sun{Eigen::Vector3f(x, 0, 1).normalized(), {1, 1, 1}, 0.02F};
        const RenderView view = lookingAt({0, -1, 4}, {0, 0, 0}, {2, 2}, 100);
        return meanRadiance(traced(PathTracer(scene), view, 16)).mean();
    };
    EXPECT_GT(brightness(1, model), 1.3F * brightness(-1, model));
    Model given = model;
    given.meshes[0].tangents.assign(4, {1, 0, 0, 1});
    EXPECT_NEAR(brightness(1, given), brightness(1, model), 1e-3F);
    given.materials[0].normalScale = 0;
    EXPECT_NEAR(brightness(1, given), brightness(-1, given), 0.01F);
}

TEST(PathTracer, DepthIsMeasuredAlongTheOpticalAxis) {
    auto scene = sceneOf(square(2, 0), materialOf({1, 1, 1}, 0, 1));
    RenderView view = lookingAt({0, 0, 3}, {0, 0, 0}, {32, 24}, 40);
    view.camera.distortion = {-0.1, 0.01, 0.001, 0, 0};
    const RenderedPicture picture = resolved(traced(PathTracer(scene), view, 1), view);
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
        ASSERT_EQ(picture.id[i], 1);
        EXPECT_NEAR(picture.depth[i], 3, 1e-5F);
    }
}

TEST(PathTracer, BoundsContainObjectsAndShadows) {
    auto scene = sceneOf(sphere({0.1F, 0, 0.3F}, 0.3F, 16), materialOf({1, 1, 1}, 0, 1));
    scene->lighting.sun = Sun{Eigen::Vector3f(0.6F, 0, 1).normalized(), {3, 3, 3}, 0.02F};
    scene->catcher = ground(4, 0.5F);
    PathTracerOptions directly;
    directly.maxDepth = 1;
    const PathTracer tracer(scene, directly);
    for (const double angle : {0.0, 1.0, 2.5}) {
        RenderView view = lookingAt({3 * std::cos(angle), 3 * std::sin(angle), 1.2},
                                    {0.3, 0.2, 0.2}, {80, 60}, 70);
        view.camera.distortion = {-0.2, 0.03, 0, 0, 0};
        const PixelRect bounds = tracer.bounds(view);
        const RenderedPicture picture = resolved(traced(tracer, view, 4), view);
        int seen = 0;
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 80; ++x) {
                if (picture.id[static_cast<std::size_t>(y * 80 + x)] == 0) continue;
                ++seen;
                EXPECT_TRUE(x >= bounds.x0 && x < bounds.x1 && y >= bounds.y0 && y < bounds.y1);
            }
        EXPECT_GT(seen, 50);
        EXPECT_LT(bounds.area(), 80 * 60);
    }
}

// A lens's table of rays takes much longer than a few samples.
TEST(PathTracer, CamerasOfDifferentResolutionCanAlternate) {
    const auto ms = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
    };
    RenderView fine = lookingAt({0, 0, 3}, {0, 0, 0}, {640, 480}, 600);
    fine.camera.distortion = {-0.28, 0.07, 0.001, 0, 0};
    RenderView coarse = fine;
    coarse.camera = fine.camera.scaledTo({160, 120});
    const double begun = ms();
    const LensRays rays(fine.camera);
    const double table = ms() - begun;
    const PathTracer tracer(sceneOf(square(2, 0), materialOf({1, 1, 1}, 0, 1)));
    Film fineFilm(fine.camera.size), coarseFilm(coarse.camera.size);
    const std::vector<std::uint32_t> pixel{10'000};
    const auto both = [&] {
        tracer.trace(fine, pixel, 1, fineFilm);
        tracer.trace(coarse, pixel, 1, coarseFilm);
    };
    both();
    const double before = ms();
    constexpr int kRounds = 40;
    for (int i = 0; i < kRounds; ++i)
        both();
    EXPECT_LT(ms() - before, 0.25 * kRounds * table);
}

TEST(PathTracer, InvalidInputIsRefused) {
    auto scene = sceneOf(square(1, 0), {});
    PathTracerOptions options;
    options.maxDepth = 0;
    EXPECT_THROW(PathTracer(scene, options), std::invalid_argument);
    EXPECT_THROW(PathTracer(nullptr), std::invalid_argument);
    const PathTracer tracer(scene);
    RenderView view = lookingAt({0, -1, 1}, {0, 0, 0}, {4, 4}, 10);
    Film film({4, 4}), small({2, 2});
    const std::vector<std::uint32_t> outside{16};
    EXPECT_THROW(tracer.trace(view, outside, 1, film), std::invalid_argument);
    EXPECT_THROW(tracer.trace(view, allPixels({2, 2}), 1, small), std::invalid_argument);
    view.camera.fx = std::nan("");
    EXPECT_THROW(tracer.trace(view, allPixels({4, 4}), 1, film), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(tracer.bounds(view)), std::invalid_argument);
}

}  // namespace
}  // namespace mfar
