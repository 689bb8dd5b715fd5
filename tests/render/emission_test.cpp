#include "pipeline/render/path_tracer.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace mfar {
namespace {

using namespace render_scenes;

Material grey(float albedo, float metallic = 0, float roughness = 1) {
    Material out;
    out.baseColour << Eigen::Vector3f::Constant(albedo), 1;
    out.metallic = metallic;
    out.roughness = roughness;
    return out;
}

Mesh moved(Mesh mesh, const Eigen::Vector3f& by) {
    for (Eigen::Vector3f& p : mesh.positions)
        p += by;
    return mesh;
}

/// A square lamp of half side `side` that faces down, at `height` over a ground of albedo 0.5.
std::shared_ptr<Scene> lampOverGround(float side, float height, const Eigen::Vector3f& emission) {
    auto out = std::make_shared<Scene>();
    Mesh mesh = square(side, height);
    for (auto& t : mesh.triangles)
        std::swap(t[1], t[2]);
    out->objects.push_back(objectOf(modelOf(mesh, lampOf(emission))));
    out->catcher = ground(50, 0.5F);
    return out;
}

/// Configuration factor between a point below the corner of a parallel rectangle and the rectangle
/// (Howell, catalogue of configuration factors, B-3). `a` and `b` are its sides divided by its
/// height.
double cornerFactor(double a, double b) {
    const double x = std::sqrt(1 + a * a), y = std::sqrt(1 + b * b);
    return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * std::numbers::pi);
}

/// A camera of 16x16 pixels that see almost the same point.
RenderView closeUp(const Eigen::Vector3d& eye, const Eigen::Vector3d& point) {
    return lookingAt(eye, point, {16, 16}, 1e5);
}

RenderView ofGround(const Eigen::Vector3d& point) {
    return closeUp(point + Eigen::Vector3d(0, -0.4, 0.02), point);
}

struct Estimate {
    double mean = 0, deviation = 0;  ///< mean and standard deviation of the pixels' radiances
    double error() const { return deviation / 16; }  ///< standard error of the mean of 256 pixels
};

/// Traces 256 pixels. A pixel's radiance is the mean of its three colours. All pixels must see
/// almost the same point, and their noise must be independent.
Estimate estimateOf(const std::shared_ptr<const Scene>& scene, const RenderView& view, int samples,
                    PathTracerOptions options = {}) {
    options.seed = 5;
    const Film film = traced(PathTracer(scene, options), view, samples);
    EXPECT_EQ(film.dropped(), 0U);
    double sum = 0, squares = 0;
    const double n = 256;
    for (const std::uint32_t p : allPixels(film.size())) {
        const Film::Means m = film.means(p);
        const double value = m.objectShare * m.object.mean() + m.catcherShare * m.with.mean();
        sum += value / n;
        squares += value * value / n;
    }
    return {sum, std::sqrt(std::max(0.0, squares - sum * sum))};
}

PathTracerOptions byChance() {
    PathTracerOptions out;
    out.emissionByChance = true;
    return out;
}

/// Leaves out light that is reflected more than once, because the tests' formulas leave it out too.
/// Even the lamps, whose colour is black, reflect a little of the ground's light.
PathTracerOptions direct() {
    PathTracerOptions out;
    out.maxDepth = 2;
    return out;
}

TEST(Emission, RectangleLightsTheGroundAsItsConfigurationFactorSays) {
    for (const float height : {0.05F, 0.5F, 4.0F}) {
        const auto scene = lampOverGround(0.5F, height, {2, 2, 2});
        for (const double x : {0.0, 0.3}) {
            const double half = 0.5 / height, a = (0.5 - x) / height, b = (0.5 + x) / height;
            const double factor = 2 * (cornerFactor(a, half) + cornerFactor(b, half));
            const Estimate seen = estimateOf(scene, ofGround({x, 0, 0}), 256, direct());
            EXPECT_NEAR(seen.mean / (2 * 0.5 * factor), 1, 0.005) << height << ' ' << x;
        }
    }
}

TEST(Emission, DiscLightsTheGroundAsItsConfigurationFactorSays) {
    auto scene = lampOverGround(1, 1, {1, 1, 1});
    Mesh disc;
    disc.positions = {{0, 0, 0.8F}};
    constexpr std::uint32_t kCorners = 256;
    for (std::uint32_t i = 0; i < kCorners; ++i) {
        const float phi = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
        disc.positions.emplace_back(0.6F * std::cos(phi), 0.6F * std::sin(phi), 0.8F);
        disc.triangles.push_back({0, 1 + (i + 1) % kCorners, 1 + i});
    }
    scene->objects = {objectOf(modelOf(disc, lampOf({3, 3, 3})))};
    EXPECT_NEAR(estimateOf(scene, ofGround({0, 0, 0}), 256, direct()).mean,
                3 * 0.5 * 0.36 / (0.36 + 0.64), 0.005);
}

TEST(Emission, BackOfALampGivesLightOnlyIfTheMaterialIsDoubleSided) {
    for (const bool doubleSided : {false, true}) {
        auto scene = lampOverGround(0.5F, 0.5F, {2, 2, 2});
        Model model = *scene->objects[0].model;
        for (auto& t : model.meshes[0].triangles)
            std::swap(t[1], t[2]);
        model.materials[0].doubleSided = doubleSided;
        scene->objects[0] = objectOf(model);
        for (PathTracerOptions options : {direct(), byChance()}) {
            options.maxDepth = 2;
            const double seen = estimateOf(scene, ofGround({0, 0, 0}), 64, options).mean;
            EXPECT_NEAR(seen, doubleSided ? 4 * cornerFactor(1, 1) : 0, 0.01);
        }
    }
}

TEST(Emission, WhiteObjectInAClosedLampLooksLikeTheLamp) {
    for (const float roughness : {0.2F, 0.6F, 1.0F})
        for (const float metallic : {0.0F, 1.0F}) {
            auto scene = std::make_shared<Scene>();
            Material lamp = lampOf({0.7F, 0.7F, 0.7F});
            lamp.doubleSided = true;
            scene->objects = {
                objectOf(modelOf(sphere({0, 0, 0}, 3, 24), lamp)),
                objectOf(modelOf(sphere({0, 0, 0}, 1, 64), grey(1, metallic, roughness)))};
            const RenderView view = closeUp({0, -2.5, 0.5}, {0, -1, 0});
            EXPECT_NEAR(estimateOf(scene, view, 64, direct()).mean, 0.7, 0.005)
                << roughness << ' ' << metallic;
        }
}

/// A scene and a view of one of its points.
struct Case {
    const char* name;
    std::shared_ptr<Scene> scene;
    RenderView view;
};

SurfaceTexture spotTexture() {
    SurfaceTexture out{{8, 8}, true, {}};
    for (int i = 0; i < 64; ++i) {
        const std::uint8_t value = i == 27 || i == 36 ? 255 : i % 8 == 0 ? 40 : 0;
        out.texels.push_back({value, value, static_cast<std::uint8_t>(value / 2), 255});
    }
    return out;
}

class LampCases {
public:
    /// Adds a lamp over a ground, with the given change.
    void add(const char* name, const RenderView& view, const std::function<void(Scene&)>& change) {
        auto scene = lampOverGround(0.4F, 0.8F, {3, 2, 1});
        scene->lighting.environment = unevenLight();
        change(*scene);
        cases_.push_back({name, scene, view});
    }
    /// Adds a lamp whose model is changed.
    void addLamp(const char* name, const std::function<void(Model&)>& change) {
        add(name, ofGround({0.3, 0, 0}), [&](Scene& s) { changeLamp(s, change); });
    }
    static void changeLamp(Scene& scene, const std::function<void(Model&)>& change) {
        Model model = *scene.objects[0].model;
        change(model);
        scene.objects[0] = objectOf(model);
    }
    [[nodiscard]] std::vector<Case> take() { return std::move(cases_); }

private:
    std::vector<Case> cases_;
};

void turnRound(Mesh& mesh) {
    for (auto& t : mesh.triangles)
        std::swap(t[1], t[2]);
}

void addLamps(LampCases& cases) {
    cases.addLamp("textured lamp", [](Model& model) {
        model.textures = {spotTexture()};
        model.materials[0].emissionTexture = 0;
        model.materials[0].emission *= 10;
    });
    cases.addLamp("lamp with holes", [](Model& model) {
        model.textures = {{{2, 1}, false, {{0, 0, 0, 255}, {0, 0, 0, 0}}}};
        model.materials[0].baseColourTexture = 0;
        model.materials[0].alphaCutoff = 0.5F;
    });
    cases.addLamp("lamp of two layers", [](Model& model) {
        model.meshes.push_back(model.meshes[0]);
        turnRound(model.meshes.back());
    });
    cases.addLamp("double-sided lamp seen from its back", [](Model& model) {
        model.materials[0].doubleSided = true;
        turnRound(model.meshes[0]);
    });
    cases.add("two lamps", ofGround({0.3, 0, 0}), [](Scene& s) {
        const Mesh ball = sphere({1.5F, 0, 0.5F}, 0.3F, 16);
        s.objects.push_back(objectOf(modelOf(ball, lampOf({0, 1, 8}))));
    });
    cases.add("ground hides half of a lamp", ofGround({0.4, 0, 0}), [](Scene& s) {
        s.objects[0] = objectOf(modelOf(sphere({0, 0, 0}, 0.3F, 24), lampOf({3, 2, 1})));
    });
}

void addFloor(Scene& scene, const Material& material) {
    // The scene has no environment, because the error of the environment's approximate light
    // depends on the number of samples, which differs between the compared pictures.
    scene.lighting.environment = nullptr;
    scene.catcher = {};
    scene.objects.push_back(objectOf(modelOf(square(3, 0), material)));
}

void addSurfaces(LampCases& cases) {
    const RenderView shown = closeUp({0, -2, 1}, {0, 0, 0});
    cases.add("ground", ofGround({0.3, 0, 0}), [](Scene&) {});
    for (const float roughness : {0.15F, 0.4F, 1.0F})
        for (const float metallic : {0.0F, 0.9F})
            cases.add(roughness < 0.3F ? "shiny floor" : "rough floor", shown,
                      [&](Scene& s) { addFloor(s, grey(0.7F, metallic, roughness)); });
    cases.add("partly hidden lamp", ofGround({0.3, 0, 0}), [](Scene& s) {
        s.objects.push_back(objectOf(modelOf(moved(square(0.2F, 0.4F), {0.1F, 0, 0}), grey(0.5F))));
    });
    cases.add("lamp that reflects", shown, [](Scene& s) {
        addFloor(s, grey(0.8F));
        LampCases::changeLamp(
            s, [](Model& model) { model.materials[0].baseColour = {0.9F, 0.9F, 0.9F, 1}; });
    });
    cases.add("surface in a corner of the lamp", closeUp({0, -2, 1}, {0, 0.49, 0}), [](Scene& s) {
        addFloor(s, grey(0.8F));
        Mesh wall = square(0.5F, 0);
        for (auto& p : wall.positions)
            p = {p.x(), 0.5F, p.y() + 0.5F};
        Material lamp = lampOf({1, 1, 1});
        lamp.doubleSided = true;
        s.objects[0] = objectOf(modelOf(wall, lamp));
    });
}

std::vector<Case> lampCases() {
    LampCases cases;
    addSurfaces(cases);
    addLamps(cases);
    return cases.take();
}

// The expected light comes from paths that hit lamps by chance. Such paths use none of the code
// that samples a lamp's triangles.
TEST(Emission, SampledLampsGiveTheSameLightAsLampsHitByChance) {
    for (const Case& c : lampCases()) {
        const Estimate expected = estimateOf(c.scene, c.view, 512, byChance());
        const Estimate seen = estimateOf(c.scene, c.view, 256);
        EXPECT_GT(expected.mean, 0.02) << c.name;
        EXPECT_NEAR(seen.mean, expected.mean, 4 * std::hypot(seen.error(), expected.error()))
            << c.name << ", relative " << seen.mean / expected.mean - 1;
        EXPECT_LT(expected.error(), 0.02 * expected.mean) << c.name;
    }
}

TEST(Emission, SampledLampHasMuchLessNoiseThanALampHitByChance) {
    auto scene = lampOverGround(0.1F, 1, {20, 20, 20});
    const double factor = 4 * cornerFactor(0.1, 0.1);
    const auto errorOf = [&](const PathTracerOptions& options) {
        const Estimate e = estimateOf(scene, ofGround({0, 0, 0}), 16, options);
        const double truth = 20 * 0.5 * factor;
        return std::hypot(e.deviation, e.mean - truth) / truth;
    };
    const double sampled = errorOf({}), chance = errorOf(byChance());
    RecordProperty("sampled", std::to_string(sampled));
    RecordProperty("chance", std::to_string(chance));
    EXPECT_LT(20 * sampled, chance);
}

TEST(Emission, BoundsContainTheGroundThatALampLights) {
    auto scene = lampOverGround(0.1F, 0.3F, {2, 2, 2});
    const RenderView view = lookingAt({0, 0, 6}, {0, 0, 0}, {200, 200}, 200);
    const PixelRect lit = PathTracer(scene).bounds(view);
    Model dark = *scene->objects[0].model;
    dark.materials[0].emission.setZero();
    scene->objects[0] = objectOf(dark);
    const PixelRect shaded = PathTracer(scene).bounds(view);
    EXPECT_GT(lit.x1 - lit.x0, 2 * (shaded.x1 - shaded.x0));
}

TEST(Emission, AMovingLampLightsAsMuchGroundAsOneAtRest) {
    const RenderView view = lookingAt({0, 0, 6}, {0, 0, 0}, {200, 200}, 200);
    auto scene = lampOverGround(0.1F, 0.3F, {2, 2, 2});
    const PixelRect atRest = PathTracer(scene).bounds(view);
    RigidPath path;
    path.length = 2;
    path.joints.resize(1);
    path.joints[0].translation = {
        MotionTrack::Between::Linear, {0, 1, 2}, {{0, 0, 0, 0}, {50, 0, 0, 0}, {0, 0, 0, 0}}};
    scene->objects[0].path = std::make_shared<const RigidPath>(path);
    EXPECT_EQ(PathTracer(scene).bounds(view), atRest);
}

TEST(Emission, GroundThatNoLampLightsIsUnchanged) {
    // In the scene `above`, the ground is above the lamp and hides it.
    auto scene = lampOverGround(0.2F, 0.8F, {3, 2, 1});
    scene->lighting.sun = Sun{Eigen::Vector3f(0.3F, 0.2F, 1).normalized(), {2, 2, 2}, 0.02F};
    scene->catcher = ground(50, 0.5F);
    Scene above = *scene;
    above.objects[0] =
        objectOf(modelOf(moved(sphere({0, 0, 0}, 0.2F, 8), {0, 0, -2}), lampOf({3, 2, 1})));
    PathTracerOptions options;
    options.maxDepth = 2;
    const RenderView view = ofGround({0.3, 0, 0});
    const Film film = traced(PathTracer(std::make_shared<const Scene>(above), options), view, 16);
    const Film lit = traced(PathTracer(scene, options), view, 16);
    for (const std::uint32_t p : allPixels(film.size())) {
        EXPECT_EQ(film.means(p).with, film.means(p).without);
        EXPECT_GT(lit.means(p).with.x(), lit.means(p).without.x());
        EXPECT_EQ(lit.means(p).without, film.means(p).without);
    }
}

TEST(Emission, InASceneWithoutEmissionTheSamplingOfLampsChangesNoBit) {
    auto scene = std::make_shared<Scene>();
    scene->objects = {objectOf(modelOf(sphere({0, 0, 0.5F}, 0.5F, 24), grey(0.8F, 0.3F, 0.3F)))};
    scene->catcher = ground(3, 0.6F);
    scene->lighting = {unevenLight(), Sun{}};
    const RenderView view = lookingAt({0.5, -3, 2}, {0, 0, 0.3}, {32, 24}, 30);
    const Film a = traced(PathTracer(scene), view, 4);
    const Film b = traced(PathTracer(scene, byChance()), view, 4);
    for (const std::uint32_t p : allPixels(a.size())) {
        EXPECT_EQ(a.means(p).object, b.means(p).object);
        EXPECT_EQ(a.means(p).with, b.means(p).with);
    }
}

// Light is stored without the surface's colour, so that the noise filter and the next picture keep
// the colours sharp.
TEST(Emission, LightOfALampIsStoredWithoutTheSurfacesColour) {
    const auto lightOn = [](float albedo) {
        auto scene = lampOverGround(0.5F, 0.5F, {2, 2, 2});
        scene->catcher = {};
        scene->objects.push_back(objectOf(modelOf(square(3, 0), grey(albedo))));
        const RenderView view = closeUp({0, -2, 1}, {0, 0, 0});
        const Film film = traced(PathTracer(scene), view, 64);
        return film.known(5).first.cwiseProduct(film.centre(5).far.diffuse).eval();
    };
    const Eigen::Vector3f dark = lightOn(0.1F), bright = lightOn(0.8F);
    EXPECT_NEAR((dark - bright).norm() / bright.norm(), 0, 0.02F);
    const double factor = 4 * cornerFactor(1, 1);
    EXPECT_NEAR(bright.x() / (2 * factor), 1, 0.1);
}

TEST(Emission, HalfAMillionGlowingTrianglesLightTheGround) {
    auto scene = lampOverGround(1, 1, {1, 1, 1});
    const Mesh lamp = sphere({0, 0, 2}, 1, 354);
    ASSERT_GT(lamp.triangles.size(), 500000U);
    scene->objects = {objectOf(modelOf(lamp, lampOf({1, 1, 1})))};
    EXPECT_NEAR(estimateOf(scene, ofGround({0, 0, 0}), 64, direct()).mean, 0.5 * 0.25, 0.001);
}

TEST(Emission, TrianglesWithoutAreaAndExtremeEmissionGiveFiniteColours) {
    for (const float emission : {1e-38F, 1.0F, 1e30F}) {
        auto scene = lampOverGround(0.4F, 0.8F, Eigen::Vector3f::Constant(emission));
        Model model = *scene->objects[0].model;
        model.meshes[0].triangles.push_back({1, 1, 1});
        model.meshes[0].triangles.push_back({0, 1, 0});
        model.meshes.push_back(moved(square(1e-6F, 0), {0.3F, 0, 0.001F}));
        model.meshes.push_back(moved(square(0.3F, 0), {0, 0, 0}));  // lies on the ground
        scene->objects = {objectOf(model)};
        for (const double x : {0.0, 0.3, 0.9}) {
            const Film film = traced(PathTracer(scene), ofGround({x, 0, 0}), 8);
            EXPECT_EQ(film.dropped(), 0U);
            EXPECT_TRUE(film.means(0).with.allFinite());
        }
    }
}

}  // namespace
}  // namespace mfar
