#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mfar {
namespace {

using namespace render_scenes;

std::shared_ptr<Scene> sphereOverGround(float radius, float height) {
    auto out = std::make_shared<Scene>();
    Material grey;
    grey.baseColour = {0.5F, 0.5F, 0.5F, 1};
    grey.metallic = 0;
    out->objects.push_back(objectOf(modelOf(sphere({0, 0, height}, radius, 48), grey)));
    out->catcher = ground(50, 0.5F);
    return out;
}

/// Traces one pixel that sees `point` on the ground. The camera is low enough to look below the
/// sphere.
Film::Means groundAt(const PathTracer& tracer, const Eigen::Vector3d& point, int samples) {
    const RenderView view = lookingAt(point + Eigen::Vector3d(0, -0.4, 0.25), point, {1, 1}, 1e4);
    return traced(tracer, view, samples).means(0);
}

TEST(ShadowCatcher, SphereBlocksTheShareOfTheSkyGivenByItsFormFactor) {
    auto scene = sphereOverGround(1, 2);
    scene->lighting.environment = evenLight(1);
    PathTracerOptions directly;
    directly.maxDepth = 1;
    const PathTracer tracer(scene, directly);
    const Film::Means under = groundAt(tracer, {0, 0, 0}, 2048);
    EXPECT_EQ(under.catcherShare, 1);
    EXPECT_NEAR(under.without.x(), 0.5F, 0.005F);
    // The form factor of the sphere for a small patch is (r / h)^2. This share of the irradiance is
    // blocked.
    EXPECT_NEAR(under.with.x() / under.without.x(), 1 - 0.25F, 0.01F);
    // At a point beside the sphere, the share also has a factor: the cosine of the angle between
    // the direction to the sphere and the ground's normal.
    const Film::Means aside = groundAt(tracer, {2, 0, 0}, 2048);
    EXPECT_NEAR(aside.with.x() / aside.without.x(), 1 - std::sqrt(0.5F) / 8, 0.01F);
}

TEST(ShadowCatcher, PenumbraIsTheCoveredShareOfTheSunsDisc) {
    // Seen from the ground at x = 0, a large roof covers half of the sun's disc.
    auto scene = std::make_shared<Scene>();
    Mesh roof = square(5, 1);
    for (Eigen::Vector3f& p : roof.positions)
        p.x() += 5;
    Material material;
    material.doubleSided = true;
    scene->objects.push_back(objectOf(modelOf(roof, material)));
    scene->catcher = ground(20, 0.5F);
    scene->lighting.sun = Sun{{0, 0, 1}, {1, 1, 1}, 0.05F};
    PathTracerOptions directly;
    directly.maxDepth = 1;
    const PathTracer tracer(scene, directly);
    const auto ratio = [&](double x) {
        const Film::Means m = groundAt(tracer, {x, 0, 0}, 1024);
        return m.with.x() / m.without.x();
    };
    const double r = std::tan(0.05);
    EXPECT_NEAR(ratio(0), 0.5, 0.01);
    EXPECT_NEAR(ratio(-1.1 * r), 1, 1e-6);
    EXPECT_NEAR(ratio(1.1 * r), 0, 1e-6);
    // Share of a disc that lies beyond a chord at half a radius from the centre.
    const double part = (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / std::numbers::pi;
    EXPECT_NEAR(ratio(0.5 * r), part, 0.01);
}

TEST(ShadowCatcher, PixelsThatObjectsDoNotAffectAreUnchanged) {
    auto scene = sphereOverGround(0.1F, 0.1F);
    scene->lighting.sun = Sun{Eigen::Vector3f(0.3F, 0.2F, 1).normalized(), {2, 2, 2}, 0.02F};
    const RenderView view = lookingAt({0, -3, 2}, {0, 0.1, 0}, {64, 48}, 120);
    PathTracerOptions directly;
    directly.maxDepth = 1;
    const RenderedPicture picture = resolved(traced(PathTracer(scene, directly), view, 8), view);
    int shadow = 0, nothing = 0;
    for (std::size_t i = 0; i < picture.id.size(); ++i) {
        shadow += picture.id[i] == kCatcherId;
        if (picture.id[i] != 0) continue;
        ++nothing;
        EXPECT_EQ(picture.colour[i], (std::array<std::uint8_t, 4>{}));
        EXPECT_EQ(picture.depth[i], 0);
    }
    EXPECT_GT(shadow, 10);
    EXPECT_GT(nothing, 2500);
}

TEST(ShadowCatcher, ShadowIsDarkAtTheContactAndFadesWithDistance) {
    auto scene = sphereOverGround(0.5F, 0.5F);
    scene->lighting.environment = evenLight(1);
    const PathTracer tracer(scene);
    float before = 0, contact = 1;
    for (const double x : {0.05, 0.2, 0.5, 1.0, 3.0}) {
        const RenderView view = lookingAt({x, -3, 0.02}, {x, 0, 0}, {1, 1}, 1e5);
        const Film::Means m = traced(tracer, view, 256).means(0);
        ASSERT_EQ(m.catcherShare, 1) << x;
        const float kept = m.with.x() / m.without.x();
        EXPECT_GT(kept, before) << x;
        before = kept;
        contact = std::min(contact, kept);
    }
    EXPECT_LT(contact, 0.15F);
    EXPECT_GT(before, 0.95F);
}

TEST(ShadowCatcher, ColourBouncesBetweenObjectAndGroundInBothDirections) {
    auto scene = sphereOverGround(0.5F, 0.5F);
    Material red;
    red.baseColour = {0.9F, 0.05F, 0.05F, 1};
    red.metallic = 0;
    scene->objects[0] = objectOf(modelOf(sphere({0, 0, 0.5F}, 0.5F, 32), red));
    scene->catcher.albedo = {0.1F, 0.1F, 0.9F};
    scene->lighting.sun = Sun{Eigen::Vector3f(-1, 0, 1).normalized(), {3, 3, 3}, 0.02F};
    const PathTracer tracer(scene);
    // Red light from the sphere is added to the ground's own light.
    const Film::Means lit = groundAt(tracer, {-0.9, 0, 0}, 512);
    const Eigen::Vector3f gain = lit.with.cwiseQuotient(lit.without);
    EXPECT_GT(gain.x(), 1.03F);
    EXPECT_LT(gain.z(), gain.x() - 0.02F);
    Material white = red;
    white.baseColour = {0.9F, 0.9F, 0.9F, 1};
    scene->objects[0] = objectOf(modelOf(sphere({0, 0, 0.8F}, 0.5F, 32), white));
    const RenderView below = lookingAt({0, -2, 0.05}, {0, -0.25, 0.37}, {2, 2}, 2000);
    const Film::Means under = traced(PathTracer(scene), below, 256).means(0);
    EXPECT_EQ(under.objectShare, 1);
    EXPECT_GT(under.object.z(), 3 * under.object.x());
}

TEST(ShadowCatcher, DoesNotHideObjectsFromTheCamera) {
    auto scene = sphereOverGround(0.5F, -1);
    scene->lighting.environment = evenLight(1);
    const RenderView view = lookingAt({0, 0, 4}, {0, 0, 0}, {4, 4}, 100);
    EXPECT_EQ(traced(PathTracer(scene), view, 2).means(5).objectShare, 1);
}

}  // namespace
}  // namespace mfar
