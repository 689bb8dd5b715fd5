#include "pipeline/render/ray_scene.h"
#include "tests/render/render_scenes.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace mfar {
namespace {

using namespace render_scenes;

RayScene sphereOnSquare() {
    RayScene out;
    const Mesh ball = sphere({0, 0, 0}, 1, 32), floor = square(3, -1);
    out.add(ball.positions, ball.triangles);
    out.add(floor.positions, floor.triangles);
    out.commit();
    return out;
}

TEST(RayScene, FindsTheNearestSurface) {
    const RayScene scene = sphereOnSquare();
    const RayHit ball = scene.first({{0, -4, 0.01F}, {0, 2, 0}});
    EXPECT_EQ(ball.mesh, 0U);
    EXPECT_NEAR(ball.t, 1.5F, 0.01F);  // `t` is in units of the direction's length
    const RayHit floor = scene.first({{2, 2, 5}, {0, 0, -1}});
    EXPECT_EQ(floor.mesh, 1U);
    EXPECT_NEAR(floor.t, 6, 1e-5F);
    EXPECT_FALSE(scene.first({{0, 0, 3}, {0, 0, 1}}).found());
    EXPECT_TRUE(scene.blocked({{2, 2, 5}, {0, 0, -1}}));
    EXPECT_FALSE(scene.blocked({{2, 2, 5}, {0, 0, -1}, 0, 5.9F}));
    EXPECT_FALSE(scene.blocked({{2, 2, 5}, {0, 0, -1}, 6.1F}));
}

/// A fan of rays. Every third ray hits an edge or a corner, and therefore several triangles at
/// once.
std::vector<Ray> fan(std::size_t count, std::mt19937& random) {
    const Mesh ball = sphere({0, 0, 0}, 1, 32);
    std::uniform_real_distribution<float> slope(-0.4F, 0.4F);
    std::vector<Ray> out;
    for (std::size_t i = 0; i < count; ++i) {
        Ray ray{{0, -4, 1}, {slope(random), 1, slope(random) - 0.25F}};
        if (i % 3 == 0) {
            const auto& corners = ball.triangles[random() % ball.triangles.size()];
            const float share = static_cast<float>(random() % 3) / 2;
            ray.direction = ball.positions[corners[0]] * (1 - share) +
                            ball.positions[corners[1]] * share - ray.origin;
        }
        out.push_back(ray);
    }
    return out;
}

TEST(RayScene, RayPacketsGiveTheHitsOfSingleRays) {
    const RayScene scene = sphereOnSquare();
    std::mt19937 random(5);
    int different = 0, found = 0;
    for (int round = 0; round < 500; ++round) {
        const std::vector<Ray> rays = fan(1 + random() % 64, random);
        std::vector<RayHit> hits(rays.size());
        scene.firstOfEach(rays, hits);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayHit alone = scene.first(rays[i]);
            found += alone.found();
            different += !(alone.mesh == hits[i].mesh && alone.t == hits[i].t &&
                           alone.triangle == hits[i].triangle && alone.u == hits[i].u &&
                           alone.v == hits[i].v);
        }
    }
    EXPECT_EQ(different, 0);
    EXPECT_GT(found, 5000);
}

TEST(RayScene, RaysPassThroughTransparentPoints) {
    RayScene scene;
    const Mesh upper = square(1, 1), lower = square(1, 0);
    // Every point is transparent, except those in one corner of the first triangle.
    const HoleTest holes{[](const void*, std::uint32_t triangle, float u, float v) {
                             return triangle != 0 || u + v > 0.5F;
                         },
                         nullptr};
    scene.add(upper.positions, upper.triangles, holes);
    scene.add(lower.positions, lower.triangles);
    scene.commit();
    const std::vector<Ray> rays{{{-0.8F, -0.9F, 3}, {0, 0, -1}}, {{0.8F, -0.7F, 3}, {0, 0, -1}}};
    std::vector<RayHit> hits(2);
    scene.firstOfEach(rays, hits);
    EXPECT_EQ(hits[0].mesh, 0U);
    EXPECT_EQ(hits[1].mesh, 1U);
    EXPECT_EQ(scene.first(rays[1]).mesh, 1U);
    EXPECT_TRUE(scene.blocked({rays[0].origin, rays[0].direction, 0, 2.5F}));
    EXPECT_FALSE(scene.blocked({rays[1].origin, rays[1].direction, 0, 2.5F}));
}

TEST(RayScene, EmptySceneHasNoHits) {
    RayScene scene;
    scene.commit();
    EXPECT_TRUE(scene.empty());
    EXPECT_TRUE(scene.box().isEmpty());
    EXPECT_FALSE(scene.first({{0, 0, 0}, {0, 0, 1}}).found());
    EXPECT_FALSE(scene.blocked({{0, 0, 0}, {0, 0, 1}}));
}

}  // namespace
}  // namespace mfar
