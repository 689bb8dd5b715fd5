#include "pipeline/composite/shadow_catcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mfar {
namespace {

const CameraModel kLens{{160, 120}, 150, 150, 79.5, 59.5, {-0.1, 0.02, 0, 0, 0}};
const Eigen::AlignedBox3d kThing(Eigen::Vector3d(-0.05, -0.05, 0),
                                 Eigen::Vector3d(0.05, 0.05, 0.1));

RigidTransform eyeAbove() {
    const Eigen::Vector3d eye(0, -0.4, 0.35);
    const Eigen::Vector3d z = -eye.normalized(), x(1, 0, 0), y = z.cross(x);
    Eigen::Matrix3d axes;
    axes << x, y, z;
    return {Eigen::Quaterniond(axes), eye};
}

/// z of the point at which a pixel's ray meets the plane at this height.
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
    EXPECT_TRUE(planeCatcher({}).triangles.empty());
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
    const ShadowCatcher c = depthCatcher(field, kLens, eyeAbove(), kAll, kThing);
    ASSERT_GT(c.triangles.size(), 100U);
    const auto off = std::count_if(c.positions.begin(), c.positions.end(),
                                   [](const auto& p) { return std::abs(p.z()) > 1e-5; });
    EXPECT_LT(off, static_cast<long>(c.positions.size()) / 50);
}

TEST(ShadowCatcher, ObjectsOnThePlaneKeepTheirHeightAndAreNotJoinedToIt) {
    const InverseDepthField field =
        fieldOf([&](int x, int y) { return depthOfPlane(x, y, x < 80 ? 0 : 0.06); }, 1e-4);
    const ShadowCatcher c = depthCatcher(field, kLens, eyeAbove(), kAll, kThing);
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

TEST(ShadowCatcher, UnknownDistantAndOutsideDepthGivesNoSurface) {
    const auto none = [](const InverseDepthField& field, const PixelRect& where) {
        return depthCatcher(field, kLens, eyeAbove(), where, kThing).triangles.empty();
    };
    EXPECT_TRUE(none(InverseDepthField(kLens.size), kAll));
    EXPECT_TRUE(none(fieldOf([](int, int) { return 20.0; }, 1e-3), kAll));
    const InverseDepthField plane =
        fieldOf([](int x, int y) { return depthOfPlane(x, y, 0); }, 1e-3);
    EXPECT_TRUE(none(plane, {200, 0, 300, 50}));
    EXPECT_FALSE(none(plane, {-50, -50, 1000, 1000}));
}

}  // namespace
}  // namespace mfar
