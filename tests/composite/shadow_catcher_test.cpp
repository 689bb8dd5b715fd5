#include "pipeline/composite/shadow_catcher.h"
#include "pipeline/scene/glow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mfar {
namespace {

const CameraModel kLens{{160, 120}, 150, 150, 79.5, 59.5, {-0.1, 0.02, 0, 0, 0}};
const Eigen::AlignedBox3d kThing(Eigen::Vector3d(-0.05, -0.05, 0),
                                 Eigen::Vector3d(0.05, 0.05, 0.1));

const std::vector<GroundPlane> kGround = {{{}, kThing}};

RigidTransform eyeAbove() {
    const Eigen::Vector3d eye(0, -0.4, 0.35);
    const Eigen::Vector3d z = -eye.normalized(), x(1, 0, 0), y = z.cross(x);
    Eigen::Matrix3d axes;
    axes << x, y, z;
    return {Eigen::Quaterniond(axes), eye};
}

/// Depth (z in the camera) of the point at which a pixel's ray meets the plane z = `height`.
double depthOfPlane(int x, int y, double height) {
    const RigidTransform T = eyeAbove();
    const Eigen::Vector3d ray = T.rotation * kLens.unproject({x, y}).homogeneous();
    return (height - T.translation.z()) / ray.z();
}

template <class F>
InverseDepthField fieldOf(F depthAt, double sigma) {
    InverseDepthField field(kLens.size);
    for (int y = 0; y < kLens.size.height; ++y) {
        for (int x = 0; x < kLens.size.width; ++x) {
            const double z = depthAt(x, y);
            const auto i = static_cast<std::size_t>(y) * kLens.size.width + x;
            if (!(z > 0)) continue;
            field.inverseDepth[i] = static_cast<float>(1 / z);
            field.variance[i] = static_cast<float>(sigma * sigma);
        }
    }
    return field;
}

constexpr PixelRect kAll{0, 0, 160, 120};

double areaOf(const ShadowCatcher& c) {
    double sum = 0;
    for (const auto& t : c.triangles) {
        const Eigen::Vector3f &a = c.positions[t[0]], &b = c.positions[t[1]],
                              &d = c.positions[t[2]];
        sum += 0.5 * (b - a).cross(d - a).norm();
    }
    return sum;
}

TEST(ShadowCatcher, PlaneReachesAroundTheObjectsOnIt) {
    const ShadowCatcher plane = planeCatcher(kThing);
    const double reach = kShadowReach * 0.5 * kThing.diagonal().norm();
    EXPECT_NEAR(areaOf(plane), (0.1 + 2 * reach) * (0.1 + 2 * reach), 1e-6);
    for (const Eigen::Vector3f& p : plane.positions)
        EXPECT_EQ(p.z(), 0);
    EXPECT_TRUE(planeCatcher(Eigen::AlignedBox3d()).triangles.empty());
    const Eigen::AlignedBox3d above = kThing.translated(Eigen::Vector3d(0, 0, 5)),
                              below = kThing.translated(Eigen::Vector3d(0, 0, -2));
    EXPECT_TRUE(planeCatcher(above).triangles.empty());
    EXPECT_TRUE(planeCatcher(below).triangles.empty());
}

TEST(ShadowCatcher, NoisyDepthOfAPlaneGivesAFlatShadowCatcher) {
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 0.01);
    const InverseDepthField field = fieldOf(
        [&](int x, int y) { return 1 / (1 / depthOfPlane(x, y, 0) + noise(random)); }, 0.01);
    const ShadowCatcher c = depthCatcher(field, kLens, eyeAbove(), kAll, kGround);
    ASSERT_GT(c.triangles.size(), 100U);
    const auto off = std::count_if(c.positions.begin(), c.positions.end(),
                                   [](const auto& p) { return std::abs(p.z()) > 1e-5; });
    EXPECT_LT(off, static_cast<long>(c.positions.size()) / 50);
}

TEST(ShadowCatcher, ObjectsOnThePlaneKeepTheirHeightAndAreNotJoinedToIt) {
    const InverseDepthField field =
        fieldOf([&](int x, int y) { return depthOfPlane(x, y, x < 80 ? 0 : 0.06); }, 1e-4);
    const ShadowCatcher c = depthCatcher(field, kLens, eyeAbove(), kAll, kGround);
    int low = 0, high = 0;
    for (const auto& t : c.triangles) {
        const float z[] = {c.positions[t[0]].z(), c.positions[t[1]].z(), c.positions[t[2]].z()};
        const auto [least, most] = std::minmax_element(std::begin(z), std::end(z));
        ASSERT_LT(*most - *least, 1e-4);
        ASSERT_TRUE(std::abs(*least) < 1e-4 || std::abs(*least - 0.06) < 1e-4);
        (*least < 0.03 ? low : high) += 1;
    }
    EXPECT_GT(low, 50);
    EXPECT_GT(high, 50);
}

TEST(ShadowCatcher, UnknownOrLargeDepthAndAreasOutsideThePictureGiveNoSurface) {
    const auto none = [](const InverseDepthField& field, const PixelRect& where) {
        return depthCatcher(field, kLens, eyeAbove(), where, kGround).triangles.empty();
    };
    EXPECT_TRUE(none(InverseDepthField(kLens.size), kAll));
    EXPECT_TRUE(none(fieldOf([](int, int) { return 20.0; }, 1e-3), kAll));
    const InverseDepthField plane =
        fieldOf([](int x, int y) { return depthOfPlane(x, y, 0); }, 1e-3);
    EXPECT_TRUE(none(plane, {200, 0, 300, 50}));
    EXPECT_FALSE(none(plane, {-50, -50, 1000, 1000}));
}

/// An object that stands on the ground, the plane z = 0 of the frame `T_world_ground`.
SceneObject standingOn(const RigidTransform& T_world_ground, double x = 0) {
    auto model = std::make_shared<Model>();
    model->meshes.resize(1);
    model->meshes[0].positions = {{-0.05F, -0.05F, 0}, {0.05F, 0.05F, 0.1F}, {0.05F, -0.05F, 0}};
    model->meshes[0].triangles = {{0, 1, 2}};
    return {model, T_world_ground * RigidTransform{{1, 0, 0, 0}, {x, 0, 0}}, 1, T_world_ground};
}

/// Frame of the ground (T_world_ground) for objects on a wall: its plane z = 0 is y = 2 in the
/// world, and its z axis is -y of the world.
RigidTransform wall() {
    Eigen::Matrix3d axes;
    axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return {Eigen::Quaterniond(axes), {0, 2, 1}};
}

TEST(ShadowCatcher, ObjectsOnATagOfAWallShadeTheWall) {
    Scene scene;
    scene.objects = {standingOn({}), standingOn(wall())};
    const std::vector<GroundPlane> planes = groundPlanes(scene);
    ASSERT_EQ(planes.size(), 2U);
    const ShadowCatcher c = planeCatcher(planes);
    int onWall = 0;
    for (const Eigen::Vector3f& p : c.positions) {
        EXPECT_TRUE(std::abs(p.z()) < 1e-6F || std::abs(p.y() - 2) < 1e-6F) << p.transpose();
        onWall += std::abs(p.y() - 2) < 1e-6F && p.z() > 0.5F;
    }
    EXPECT_EQ(onWall, 81);
    EXPECT_EQ(c.triangles.size(), 256U);
    for (const auto& t : c.triangles)
        for (const std::uint32_t corner : t)
            EXPECT_LT(corner, c.positions.size());
    Scene floor;
    floor.objects = {standingOn({}), standingOn({})};
    EXPECT_EQ(groundPlanes(floor).size(), 1U);
    EXPECT_EQ(planeCatcher(groundPlanes(floor)).positions, planeCatcher(kThing).positions);
}

TEST(ShadowCatcher, LightOfAGlowingObjectReachesFartherThanAShadow) {
    Scene scene;
    scene.objects = {standingOn({})};
    const float dark = planeCatcher(groundPlanes(scene)).positions.back().x();
    Model lamp = *scene.objects[0].model;
    lamp.materials.resize(1);
    lamp.materials[0].emission = {0, 0, 1};
    scene.objects[0].model = std::make_shared<const Model>(lamp);
    const float lit = planeCatcher(groundPlanes(scene)).positions.back().x();
    // The scene has no light but the lamp. So the glow has its longest reach.
    EXPECT_NEAR(lit - 0.05F, kMostGlowReach * (dark - 0.05F), 1e-5);
}

TEST(ShadowCatcher, TheReachOfAGlowGrowsWithItsShareOfTheLight) {
    Scene scene;
    scene.objects = {standingOn({})};
    scene.lighting.environment = std::make_shared<const Environment>(
        Environment{{4, 2}, std::vector<Eigen::Vector3f>(8, {1, 1, 1})});
    const auto reachAt = [&](float emission) {
        Model lamp = *scene.objects[0].model;
        lamp.materials.resize(1);
        lamp.materials[0].emission.setConstant(emission);
        scene.objects[0].model = std::make_shared<const Model>(lamp);
        return glowReach(scene);
    };
    EXPECT_EQ(reachAt(0), 1);
    EXPECT_EQ(reachAt(1e-4F), 1);
    double brightest = 1e-4F;
    while (reachAt(static_cast<float>(brightest)) < 2)
        brightest *= 1.01;
    // Light decreases with the square of the distance. So the reach grows with the square root of
    // the emission.
    EXPECT_NEAR(reachAt(static_cast<float>(2.25 * brightest)), 3, 0.05);
    EXPECT_EQ(reachAt(static_cast<float>(1e3 * brightest)), kMostGlowReach);
}

TEST(ShadowCatcher, TagsOnTheSameSurfaceGiveOnePlane) {
    // The second tag's pose has an error of 2 mm and half a degree.
    RigidTransform other = wall();
    other.translation += Eigen::Vector3d(0.3, 0.002, 0);
    other.rotation = other.rotation * Eigen::AngleAxisd(0.009, Eigen::Vector3d::UnitX());
    Scene scene;
    scene.objects = {standingOn(wall()), standingOn(other)};
    const std::vector<GroundPlane> planes = groundPlanes(scene);
    ASSERT_EQ(planes.size(), 2U) << "expected the tag map's plane and the wall's plane";
    EXPECT_NEAR(planes[1].objects.sizes().x(), 0.4, 1e-3);
    RigidTransform paper;
    paper.translation.z() = 0.003;
    scene.objects = {standingOn(paper)};
    EXPECT_EQ(groundPlanes(scene).size(), 1U);
    paper.translation.z() = 0.05;  // a tag on a box
    scene.objects = {standingOn(paper)};
    EXPECT_EQ(groundPlanes(scene).size(), 2U);
}

TEST(ShadowCatcher, NoisyDepthOfAWallGivesAFlatShadowCatcher) {
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 0.01);
    // In the wall's coordinates, the wall is the plane z = 0, and the camera has the pose
    // eyeAbove().
    const RigidTransform T_world_video = wall() * eyeAbove();
    const InverseDepthField field = fieldOf(
        [&](int x, int y) { return 1 / (1 / depthOfPlane(x, y, 0) + noise(random)); }, 0.01);
    Scene scene;
    scene.objects = {standingOn(wall())};
    const ShadowCatcher c = depthCatcher(field, kLens, T_world_video, kAll, groundPlanes(scene));
    ASSERT_GT(c.triangles.size(), 100U);
    const auto off = std::count_if(c.positions.begin(), c.positions.end(),
                                   [](const auto& p) { return std::abs(p.y() - 2) > 1e-5; });
    EXPECT_LT(off, static_cast<long>(c.positions.size()) / 50);
}

TEST(ShadowCatcher, PointsNearTwoPlanesAreMovedOntoTheNearerPlane) {
    const RigidTransform box{{1, 0, 0, 0}, {0, 0, 0.03}};
    const std::vector<GroundPlane> planes = {{{}, kThing}, {box, kThing}};
    const InverseDepthField field =
        fieldOf([](int x, int y) { return depthOfPlane(x, y, x < 80 ? 0.002 : 0.028); }, 0.1);
    const ShadowCatcher c = depthCatcher(field, kLens, eyeAbove(), kAll, planes);
    const auto count = [&](float height) {
        return std::ranges::count_if(
            c.positions, [&](const auto& p) { return std::abs(p.z() - height) < 1e-5F; });
    };
    EXPECT_GT(count(0), 100);
    EXPECT_GT(count(0.03F), 100);
    EXPECT_EQ(count(0) + count(0.03F), static_cast<long>(c.positions.size()));
}

}  // namespace
}  // namespace mfar
