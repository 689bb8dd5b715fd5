#include "pipeline/composite/scene_follower.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mfar {
namespace {

const CameraModel kFollowing{{160, 120}, 150, 150, 79.5, 59.5, {}};
constexpr PixelRect kPicture{0, 0, 160, 120};

/// Pose of a camera that looks at the world's origin from a distance of 0.5: straight down if
/// `angle` [rad] is 0, else rotated about the world's x axis by `angle`.
RigidTransform downAt(double angle) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()));
    const Eigen::Quaterniond down(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
    return {turn * down, turn * Eigen::Vector3d(0, 0, 0.5)};
}

Scene cube() {
    Scene scene;
    auto model = std::make_shared<Model>();
    model->materials.resize(1);
    model->meshes.resize(1);
    model->meshes[0].positions = {{-0.05F, -0.05F, 0}, {0.05F, 0.05F, 0}, {0, 0, 0.1F}};
    model->meshes[0].triangles = {{0, 1, 2}};
    scene.objects.push_back({model, {}, 1});
    scene.catcher.albedo = {0.1F, 0.2F, 0.3F};
    return scene;
}

/// Depth of a table whose top is the plane z = `height`, seen from downAt(0). `known`: share of
/// pixels with known depth.
InverseDepthField table(double height, double known = 1) {
    InverseDepthField field(kFollowing.size);
    for (std::size_t i = 0; i < field.inverseDepth.size(); ++i) {
        if (static_cast<double>(i % 100) >= 100 * known) continue;
        field.inverseDepth[i] = static_cast<float>(1 / (0.5 - height));
        field.variance[i] = 1e-8F;
    }
    return field;
}

Timestamp atSecond(int s) {
    return Timestamp::fromSeconds(s);
}

std::shared_ptr<const Scene> followed(SceneFollower& follower, const InverseDepthField& field,
                                      const RigidTransform& T_world_video, int second,
                                      const PixelRect& region = kPicture,
                                      const PixelRect& measured = kPicture) {
    return follower.follow({field, measured, kFollowing, T_world_video, atSecond(second)}, region);
}

bool isFlatAt(const ShadowCatcher& c, float z) {
    return !c.positions.empty() &&
           std::all_of(c.positions.begin(), c.positions.end(),
                       [&](auto& p) { return std::abs(p.z() - z) < 1e-4F; });
}

TEST(SceneFollower, ShadowsFallOntoAPlaneUntilDepthIsKnown) {
    SceneFollower follower({.settling = 3});
    const auto first = follower.set(cube());
    EXPECT_TRUE(isFlatAt(first->catcher, 0));
    EXPECT_EQ(first->catcher.albedo, cube().catcher.albedo);
    const auto follow = [&](double known, int s) {
        return followed(follower, table(0.03, known), downAt(0), s);
    };
    EXPECT_EQ(follow(1, 1), nullptr);
    EXPECT_EQ(follow(1, 2), nullptr);
    EXPECT_EQ(follow(0.5, 3), nullptr);
    const auto measured = follow(1, 4);
    ASSERT_NE(measured, nullptr);
    EXPECT_TRUE(isFlatAt(measured->catcher, 0.03F));
    EXPECT_EQ(measured->catcher.albedo, cube().catcher.albedo);
    EXPECT_EQ(measured->objects.size(), 1U);
}

TEST(SceneFollower, ANewLightChangesNothingElse) {
    SceneFollower follower;
    const auto before = follower.set(cube());
    const Lighting light{std::make_shared<const Environment>(), Sun{}};
    const auto after = follower.relight(light);
    EXPECT_EQ(after->lighting.environment, light.environment);
    EXPECT_TRUE(after->lighting.sun.has_value());
    EXPECT_EQ(after->objects.size(), before->objects.size());
    EXPECT_EQ(after->catcher.positions, before->catcher.positions);
    EXPECT_EQ(followed(follower, table(0.03), downAt(0), 1), nullptr);
}

TEST(SceneFollower, IfTheViewTurnsTheShadowCatcherIsRebuiltAfterTheLeastInterval) {
    SceneFollower follower({.settling = 1, .leastKnown = 0.5, .turn = 0.3, .leastInterval = 4});
    follower.set(cube());
    const auto follow = [&](double angle, int s) {
        return followed(follower, table(0), downAt(angle), s);
    };
    ASSERT_NE(follow(0, 1), nullptr);
    EXPECT_EQ(follow(0, 100), nullptr);
    EXPECT_EQ(follow(0.2, 100), nullptr);
    EXPECT_NE(follow(0.35, 100), nullptr);
    EXPECT_EQ(follow(0, 103), nullptr);
    EXPECT_NE(follow(0, 105), nullptr);
}

TEST(SceneFollower, OutsideOfTheViewTheShadowCatcherRemainsAPlane) {
    SceneFollower follower({.settling = 0});
    const auto reach = [](const ShadowCatcher& c) {
        Eigen::AlignedBox3f box;
        for (const auto& triangle : c.triangles)
            for (const std::uint32_t vertex : triangle)
                box.extend(c.positions[vertex]);
        return box;
    };
    const auto planes = reach(follower.set(cube())->catcher);
    // The right border of the picture cuts through the objects.
    RigidTransform aside = downAt(0);
    aside.translation.x() -= 0.25;
    const auto scene = followed(follower, table(0.03), aside, 1);
    ASSERT_NE(scene, nullptr);
    const ShadowCatcher& c = scene->catcher;
    EXPECT_NEAR(reach(c).max().x(), planes.max().x(), 1e-6F);
    EXPECT_NEAR(reach(c).min().x(), -planes.max().x(), 0.02F);
    for (const auto& t : c.triangles) {
        const auto at = [&](int i) { return c.positions[t[static_cast<std::size_t>(i)]]; };
        const float left = std::min({at(0).x(), at(1).x(), at(2).x()});
        EXPECT_EQ(at(0).z() < 0.01F, left > 0.018F) << left;
    }
}

TEST(SceneFollower, DepthOfAPartOfTheRegionDoesNotReplaceTheShadowCatcher) {
    SceneFollower follower({.settling = 0});
    follower.set(cube());
    const PixelRect region{20, 20, 140, 100};
    const auto follow = [&](const PixelRect& measured) {
        return followed(follower, table(0.03), downAt(0), 1, region, measured);
    };
    EXPECT_EQ(follow({20, 20, 130, 100}), nullptr);
    EXPECT_EQ(follow({20, 30, 140, 100}), nullptr);
    EXPECT_NE(follow({16, 16, 144, 112}), nullptr);
}

TEST(SceneFollower, WithoutObjectsInThePictureTheShadowCatcherIsNotRebuilt) {
    SceneFollower follower({.settling = 0});
    EXPECT_EQ(followed(follower, table(0), downAt(0), 1), nullptr);
    EXPECT_TRUE(follower.set({})->catcher.positions.empty());
    EXPECT_EQ(followed(follower, table(0), downAt(0), 2), nullptr);
    follower.set(cube());
    EXPECT_EQ(followed(follower, table(0), downAt(0), 3, {}), nullptr);
    EXPECT_NE(followed(follower, table(0), downAt(0), 3, {-9, -9, 900, 900}), nullptr);
}

}  // namespace
}  // namespace mfar
