#include "pipeline/scene/rigid_path.h"
#include "pipeline/scene/scene_bounds.h"
#include "pipeline/scene/scene_parts.h"
#include "tests/models/near_points.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mfar {
namespace {

using enum MotionTrack::Between;
using test::expectNear;

Eigen::Vector4d turned(double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)).coeffs();
}

TEST(MotionTrack, LinearTranslationsAreInterpolatedAndHeldAtTheEnds) {
    const MotionTrack track{Linear, {1, 3}, {{0, 0, 0, 0}, {2, 4, 6, 0}}};
    expectNear(track.translationAt(0), {0, 0, 0});
    expectNear(track.translationAt(1.5), {0.5, 1, 1.5});
    expectNear(track.translationAt(9), {2, 4, 6});
}

TEST(MotionTrack, StepsHoldEachValueUntilTheNextTime) {
    const MotionTrack track{Step, {0, 1}, {{1, 0, 0, 0}, {2, 0, 0, 0}}};
    expectNear(track.translationAt(0.999), {1, 0, 0});
    expectNear(track.translationAt(1), {2, 0, 0});
}

TEST(MotionTrack, LinearRotationsTurnAtAConstantRateOnTheShorterWay) {
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    // A quaternion and its negative are the same rotation.
    const MotionTrack track{Linear, {0, 1}, {turned(0, z), -turned(1.2, z)}};
    EXPECT_NEAR(track.rotationAt(0.25).angularDistance(Eigen::Quaterniond(turned(0.3, z))), 0,
                1e-9);
}

// A cubic that the spline must reproduce: x(t) = t^3 - 2 t on [1, 3].
TEST(MotionTrack, SplinesReproduceACubic) {
    const auto x = [](double t) { return t * t * t - 2 * t; };
    const auto rate = [](double t) { return 3 * t * t - 2; };
    MotionTrack track{CubicSpline, {1, 3}, {}};
    for (const double t : track.times)
        for (const double value : {rate(t), x(t), rate(t)})
            track.values.emplace_back(value, 0, 0, 0);
    for (const double t : {1.0, 1.3, 2.0, 2.9, 3.0})
        EXPECT_NEAR(track.translationAt(t).x(), x(t), 1e-9) << t;
}

TEST(MotionTrack, SplinesOfRotationsStayRotations) {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
    const Eigen::Vector4d none = Eigen::Vector4d::Zero();
    const MotionTrack track{
        CubicSpline, {0, 2}, {none, turned(0, x), none, none, turned(2, x), none}};
    EXPECT_NEAR(track.rotationAt(1).norm(), 1, 1e-12);
    EXPECT_NEAR(track.rotationAt(1).angularDistance(Eigen::Quaterniond(turned(1, x))), 0, 1e-9);
}

/// A joint that turns about z once in 4 s, and one metre from it a joint that moves up and down.
RigidPath swing() {
    RigidPath path;
    path.length = 4;
    const double pi = std::numbers::pi;
    RigidPath::Joint& turn = path.joints.emplace_back();
    turn.rotation = {Linear, {}, {}};
    for (int quarter = 0; quarter <= 4; ++quarter) {
        turn.rotation.times.push_back(quarter);
        turn.rotation.values.push_back(turned(quarter * pi / 2, Eigen::Vector3d::UnitZ()));
    }
    RigidPath::Joint& lift = path.joints.emplace_back();
    lift.T_parent_joint.translation = {1, 0, 0};
    lift.translation = {Linear, {0, 2, 4}, {{0, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 0}}};
    return path;
}

TEST(RigidPath, JointsAreChained) {
    expectNear(swing().at(0).translation, {1, 0, 0});
    expectNear(swing().at(1).translation, {0, 1, 0.5});
    expectNear(swing().at(1) * Eigen::Vector3d(1, 0, 0), {0, 2, 0.5});
}

TEST(RigidPath, MotionRepeatsAlsoBeforeTimeZero) {
    for (const double time : {1 + 4.0, 1 + 4e6, 1 - 8.0})
        EXPECT_LT((swing().at(time).translation - swing().at(1).translation).norm(), 1e-6) << time;
}

TEST(RigidPath, AJointWithoutKeyframesRests) {
    RigidPath path = swing();
    path.joints[0].rotation = {};
    path.joints[0].rest.translation = {0, 0, 5};
    expectNear(path.at(1).translation, {1, 0, 5.5});
}

TEST(RigidPath, APlacedPathIsScaledBeforeItIsPlaced) {
    const RigidTransform T{Eigen::Quaterniond(turned(1, {0, 1, 0})), {3, 2, 1}};
    const RigidPath placed = swing().placed(T, 2);
    for (const double time : {0.0, 0.7, 3.9}) {
        expectNear(placed.at(time).translation, T * (2 * swing().at(time).translation));
        EXPECT_NEAR(
            placed.at(time).rotation.angularDistance(T.rotation * swing().at(time).rotation), 0,
            1e-7);
    }
}

/// A model of a triangle that rests and one that moves on swing().
SceneObject movingModel() {
    auto model = std::make_shared<Model>();
    model->materials.emplace_back();
    for (const int part : {0, 1}) {
        Mesh& mesh = model->meshes.emplace_back();
        mesh.positions = {{0, 0, 0}, {0.1F, 0, 0}, {0, 0.1F, 0}};
        mesh.triangles = {{0, 1, 2}};
        mesh.part = part;
    }
    model->paths = {swing()};
    return {model, {Eigen::Quaterniond::Identity(), {0, 0, 7}}, 2};
}

TEST(SceneParts, EachMovingPartIsAnObject) {
    Scene scene;
    scene.objects = partsOf(movingModel());
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].path, nullptr);
    EXPECT_EQ(std::ranges::distance(meshesOf(scene.objects[1])), 1);
    EXPECT_TRUE(moves(scene));
    const Scene later = sceneAt(scene, Timestamp::fromSeconds(1));
    expectNear(later.objects[0].T_world_object.translation, {0, 0, 7});
    expectNear(later.objects[1].T_world_object.translation, {0, 2, 8});
    expectNear(posesAt(later, Timestamp::fromSeconds(0))[1].translation, {2, 0, 7});
    EXPECT_FALSE(later.objects == scene.objects);
    scene.objects.pop_back();
    EXPECT_FALSE(moves(scene));
}

TEST(SceneParts, APartWithoutMeshesIsLeftOut) {
    SceneObject object = movingModel();
    auto model = std::make_shared<Model>(*object.model);
    model->meshes.erase(model->meshes.begin());
    object.model = model;
    ASSERT_EQ(partsOf(object).size(), 1U);
    EXPECT_EQ(partsOf(object)[0].part, 1);
}

TEST(SceneParts, BoundsOfAMovingPartContainAllItsPoses) {
    const SceneObject moving = partsOf(movingModel()).at(1);
    const Eigen::AlignedBox3d box = boundsIn({}, moving);
    for (double time = 0; time < 4; time += 0.25)
        EXPECT_TRUE(box.contains(moving.path->at(time).translation)) << time;
    EXPECT_LT(box.diagonal().norm(), 8);
}

TEST(SceneParts, BoundsOfAMovingPartContainAShortMotion) {
    SceneObject moving = partsOf(movingModel()).at(1);
    RigidPath path;
    path.length = 120;
    path.joints.resize(1);
    path.joints[0].translation.times = {0, 60.5, 61, 61.5, 120};
    path.joints[0].translation.values.assign(5, Eigen::Vector4d::Zero());
    path.joints[0].translation.values[2].x() = 5;
    path.joints[0].translation.values[4].y() = 7;
    moving.path = std::make_shared<const RigidPath>(path);
    const Eigen::AlignedBox3d box = boundsIn({}, moving);
    EXPECT_GE(box.max().x(), 5);
    EXPECT_GE(box.max().y(), 6.999);
}

}  // namespace
}  // namespace mfar
