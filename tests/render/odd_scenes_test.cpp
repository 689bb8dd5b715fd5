#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

using namespace render_scenes;

Lighting allLight() {
    return {unevenLight(), Sun{Eigen::Vector3f(0.3F, 0.2F, 1).normalized(), {2, 2, 2}, 0.02F}};
}

std::shared_ptr<Scene> oddScene(Mesh mesh) {
    auto out = std::make_shared<Scene>();
    Material material;
    material.metallic = 0.5F;
    material.roughness = 0.4F;
    material.doubleSided = true;
    out->objects.push_back(objectOf(modelOf(std::move(mesh), material)));
    out->catcher = ground(3, 0.6F);
    out->lighting = allLight();
    return out;
}

/// Traces the scene and expects finite results. Returns the number of pixels that show an object or
/// its shadow.
int tracedSoundly(const std::shared_ptr<const Scene>& scene, const RenderView& view) {
    const PathTracer tracer(scene);
    const Film film = traced(tracer, view, 4);
    EXPECT_EQ(film.dropped(), 0U);
    const PixelRect bounds = tracer.bounds(view);
    EXPECT_TRUE(bounds.x0 >= 0 && bounds.y1 <= view.camera.size.height);
    const RenderedPicture picture = resolved(film, view);
    int seen = 0;
    for (std::size_t i = 0; i < picture.id.size(); ++i) {
        EXPECT_TRUE(std::isfinite(picture.depth[i]) && picture.depth[i] >= 0);
        EXPECT_TRUE(std::isfinite(film.error(i)));
        seen += picture.id[i] != 0;
    }
    return seen;
}

const RenderView kOddView = lookingAt({0.5, -3, 2}, {0, 0, 0.3}, {32, 24}, 30);

TEST(OddScenes, EmptyScenesAreTransparent) {
    EXPECT_EQ(tracedSoundly(std::make_shared<Scene>(), kOddView), 0);
    auto bare = std::make_shared<Scene>();
    bare->lighting = allLight();
    bare->catcher = ground(1, 0.5F);
    EXPECT_EQ(tracedSoundly(bare, kOddView), 0);
    EXPECT_TRUE(PathTracer(bare).bounds(kOddView).empty());
    bare->objects.push_back(objectOf(modelOf({}, {})));
    EXPECT_EQ(tracedSoundly(bare, kOddView), 0);
}

TEST(OddScenes, TrianglesWithoutAreaGiveFiniteColours) {
    Mesh mesh = sphere({0, 0, 0.5F}, 0.5F, 12);
    mesh.triangles.push_back({3, 3, 3});
    mesh.triangles.push_back({3, 4, 3});
    mesh.positions.push_back(0.5F * (mesh.positions[40] + mesh.positions[41]));
    mesh.normals.push_back({0, 0, 0});
    mesh.triangles.push_back({40, 41, static_cast<std::uint32_t>(mesh.positions.size() - 1)});
    EXPECT_GT(tracedSoundly(oddScene(mesh), kOddView), 50);
    Mesh flat;
    flat.positions.assign(3, {0.1F, 0.1F, 0.1F});
    flat.triangles = {{0, 1, 2}};
    EXPECT_EQ(tracedSoundly(oddScene(flat), kOddView), 0);
}

TEST(OddScenes, ThinHugeAndTinyTrianglesGiveFiniteColours) {
    Mesh sliver;
    sliver.positions = {{-1, 0, 0.3F}, {1, 1e-7F, 0.3F}, {1, 0, 0.3F}};
    sliver.triangles = {{0, 1, 2}};
    EXPECT_GE(tracedSoundly(oddScene(sliver), kOddView), 0);
    Mesh vast = square(1e18F, 0.2F);
    EXPECT_GT(tracedSoundly(oddScene(vast), kOddView), 300);
    Mesh tiny = sphere({0, 0, 0.3F}, 1e-6F, 8);
    EXPECT_GE(tracedSoundly(oddScene(tiny), kOddView), 0);
}

TEST(OddScenes, SingleTriangleIsVisible) {
    Mesh one;
    one.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 0, 1.5F}};
    one.triangles = {{0, 1, 2}};
    EXPECT_GT(tracedSoundly(oddScene(one), kOddView), 20);
}

TEST(OddScenes, HalfAMillionTrianglesAreVisible) {
    const Mesh mesh = sphere({0, 0, 0.5F}, 0.5F, 354);
    ASSERT_GT(mesh.triangles.size(), 500000U);
    EXPECT_GT(tracedSoundly(oddScene(mesh), kOddView), 50);
}

TEST(OddScenes, CameraInsideAnObjectSeesItsInside) {
    auto scene = oddScene(sphere({0, 0, 0}, 5, 16));
    EXPECT_EQ(tracedSoundly(scene, kOddView), 32 * 24);
    EXPECT_EQ(PathTracer(scene).bounds(kOddView), (PixelRect{0, 0, 32, 24}));
    auto single = std::make_shared<Scene>();
    single->objects.push_back(objectOf(modelOf(sphere({0, 0, 0}, 5, 16), {})));
    single->lighting = allLight();
    EXPECT_EQ(tracedSoundly(single, kOddView), 0);
}

TEST(OddScenes, CameraOnASurfaceGivesFiniteColours) {
    const RenderView onGround = lookingAt({0, -1, 0}, {0, 0, 0}, {32, 24}, 30);
    EXPECT_GT(tracedSoundly(oddScene(sphere({0, 0, 0.5F}, 0.5F, 16)), onGround), 20);
    const RenderView onSphere = lookingAt({0, -0.5, 0.5}, {0, 0, 0.5}, {32, 24}, 30);
    EXPECT_GE(tracedSoundly(oddScene(sphere({0, 0, 0.5F}, 0.5F, 16)), onSphere), 0);
}

TEST(OddScenes, ObjectsBehindTheCameraAreInvisible) {
    const RenderView away = lookingAt({0, -3, 1}, {0, -6, 1}, {32, 24}, 30);
    auto scene = oddScene(sphere({0, 0, 0.5F}, 0.5F, 16));
    scene->catcher = {};
    EXPECT_EQ(tracedSoundly(scene, away), 0);
    EXPECT_TRUE(PathTracer(scene).bounds(away).empty());
}

TEST(OddScenes, BrightAndFaintLightsGiveFiniteColours) {
    auto scene = oddScene(sphere({0, 0, 0.5F}, 0.5F, 16));
    auto bright = std::make_shared<Environment>(*unevenLight());
    bright->radiance[100] = {1e8F, 1e8F, 1e8F};
    scene->lighting.environment = bright;
    EXPECT_GT(tracedSoundly(scene, kOddView), 50);
    scene->lighting = {evenLight(1e-30F), Sun{{0, 0, 1}, {1e-20F, 0, 0}, 1e-4F}};
    EXPECT_GT(tracedSoundly(scene, kOddView), 50);
}

}  // namespace
}  // namespace mfar
