#include "pipeline/slices/picture_scene.h"
#include "pipeline/slices/view_change.h"
#include "tests/render/render_scenes.h"
#include "tests/render/still_life.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mfar {
namespace {

using render_scenes::viewFrom;

constexpr Size kSize{64, 48};
const ViewLimits kLimits{4, 0.2};
const std::vector<ObjectBall> kBall{{{0, 0, 0}, 0.1}};

RenderView turned(RenderView view, double degrees) {
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitY());
    view.T_world_camera.rotation = view.T_world_camera.rotation * turn;
    return view;
}

double change(const RenderView& from, const RenderView& to) {
    return viewChange(from, to, kBall, kLimits);
}

TEST(ViewChange, IsTheAngleAboutTheObjectRelativeToTheLimit) {
    // At elevation 0, the camera's azimuth is its angle about the object. kLimits allows 4 degrees.
    const RenderView from = viewFrom(kSize, 20, 0);
    EXPECT_NEAR(change(from, from), 0, 1e-12);
    EXPECT_NEAR(change(from, viewFrom(kSize, 22, 0)), 0.5, 1e-9);
    EXPECT_NEAR(change(from, viewFrom(kSize, 12, 0)), 2, 1e-9);
    EXPECT_NEAR(change(from, viewFrom(kSize, 20, 4)), 1, 1e-9);
}

TEST(ViewChange, IsTheChangeOfDistanceRelativeToTheLimit) {
    const RenderView near = viewFrom(kSize, 20, 30, 1), far = viewFrom(kSize, 20, 30, 1.3);
    EXPECT_NEAR(change(near, far), 1.5, 1e-9);
    EXPECT_NEAR(change(far, near), 1.5, 1e-9);
}

TEST(ViewChange, PureRotationIsIgnoredForWhollyVisibleObjects) {
    const RenderView from = viewFrom(kSize, 20);
    EXPECT_NEAR(change(from, turned(from, 8)), 0, 1e-9);
    const RenderView cut = turned(from, 24);  // the object crosses the picture's border
    EXPECT_NEAR(change(cut, turned(cut, 2)), 0.5, 0.01);
    EXPECT_NEAR(change(cut, turned(cut, -8)), 2, 0.01);
}

TEST(ViewChange, AppearingObjectIsAnInfiniteChangeAndDisappearingObjectIsNoChange) {
    const RenderView from = viewFrom(kSize, 20), away = turned(viewFrom(kSize, 60), 180);
    EXPECT_EQ(change(from, away), 0);
    EXPECT_TRUE(std::isinf(change(away, from)));
}

TEST(ViewChange, OtherLensOrSizeIsAnInfiniteChange) {
    const RenderView from = viewFrom(kSize, 20);
    RenderView other = from;
    other.camera.distortion[0] = 0.01;
    EXPECT_TRUE(std::isinf(change(from, other)));
    EXPECT_TRUE(std::isinf(change(from, viewFrom({128, 96}, 20))));
}

TEST(ViewChange, IsFiniteInsideAnObjectAndNeverNanAtItsCentre) {
    const RenderView inside = viewFrom(kSize, 20, 30, 0.05);
    RenderView middle = inside;
    middle.T_world_camera.translation.setZero();
    EXPECT_TRUE(std::isfinite(change(inside, turned(inside, 5))));
    EXPECT_FALSE(std::isnan(change(inside, middle)));
    EXPECT_FALSE(std::isnan(change(middle, middle)));
}

TEST(PictureScene, ChangeOfAViewWithoutObjectsIsThatOfTheirShadows) {
    PictureScene scene;
    scene.balls = kBall;
    const RenderView near = viewFrom(kSize, 20), away = turned(near, 40);
    EXPECT_EQ(scene.changeOf(near, away, kLimits), 0) << "without shadow catcher";
    scene.shaded = ObjectBall{kBall[0].centre, 0.5};
    EXPECT_GT(scene.changeOf(near, away, kLimits), 5);
    EXPECT_NEAR(scene.changeOf(away, turned(away, 2), kLimits), 0.5, 0.01);
    EXPECT_TRUE(std::isinf(scene.changeOf(turned(near, 180), away, kLimits)));
    EXPECT_EQ(scene.changeOf(away, turned(near, 180), kLimits), 0);
    // Shadows make no difference where objects are visible.
    EXPECT_EQ(scene.changeOf(near, turned(near, 8), kLimits), change(near, turned(near, 8)));
}

TEST(ObjectBalls, BoundingSpheresContainAllVertices) {
    const auto scene = render_scenes::stillLife();
    const std::vector<ObjectBall> balls = objectBalls(*scene);
    ASSERT_EQ(balls.size(), scene->objects.size());
    for (std::size_t k = 0; k < balls.size(); ++k)
        for (const Eigen::Vector3f& p : scene->objects[k].model->meshes[0].positions) {
            const Eigen::Vector3d world = scene->objects[k].T_world_object * p.cast<double>();
            EXPECT_LE((world - balls[k].centre).norm(), balls[k].radius + 1e-6);
        }
}

TEST(LightChange, IsRelativeToTheStrongerLight) {
    Lighting a;
    a.environment = render_scenes::unevenLight();
    EXPECT_EQ(lightChange(a, a), 0);
    Lighting half = a;
    auto darker = std::make_shared<Environment>(*a.environment);
    for (Eigen::Vector3f& radiance : darker->radiance)
        radiance *= 0.5F;
    half.environment = darker;
    EXPECT_NEAR(lightChange(a, half), 0.5, 1e-6);
    EXPECT_NEAR(lightChange(half, a), 0.5, 1e-6);
    EXPECT_NEAR(lightChange({}, a), 1, 1e-6);
    EXPECT_EQ(lightChange({}, {}), 0);
}

TEST(LightChange, DetectsAMovingSun) {
    Lighting a;
    a.sun.emplace();
    a.sun->towards = {0, 0, 1};
    Lighting b = a;
    b.sun->towards = {1, 0, 0};
    EXPECT_NEAR(lightChange(a, b), 1, 1e-6);
    b.sun->towards = Eigen::Vector3f(0.05F, 0, 1).normalized();
    EXPECT_NEAR(lightChange(a, b), 0.05, 0.001);
}

TEST(SameObjects, PoseModelAndShadowCatcherDistinguishObjects) {
    const auto scene = render_scenes::stillLife();
    Scene other = *scene;
    other.lighting = {};
    EXPECT_TRUE(sameObjects(*scene, other));
    other.objects[1].T_world_object.translation.x() += 0.01;
    EXPECT_FALSE(sameObjects(*scene, other));
    other = *scene;
    other.objects[0].model = other.objects[1].model;
    EXPECT_FALSE(sameObjects(*scene, other));
    other = *scene;
    other.catcher.positions[0].z() = 0.1F;
    EXPECT_FALSE(sameObjects(*scene, other));
    other = *scene;
    other.objects.pop_back();
    EXPECT_FALSE(sameObjects(*scene, other));
}

}  // namespace
}  // namespace mfar
