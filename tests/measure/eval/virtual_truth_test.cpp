#include "tests/measure/eval/virtual_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mfar::eval {
namespace {

VirtualObject objectAt(VirtualShape shape, const Eigen::Vector3d& position) {
    VirtualObject out;
    out.shape = shape;
    out.size = {0.4, 0.2, 0.1};
    out.T_world_object.translation = position;
    return out;
}

TEST(VirtualTruth, SizeOfAnEllipsoidGivesItsAxes) {
    const VirtualObject sphere = objectAt(VirtualShape::Sphere, {0, 0, 2});
    EXPECT_NEAR(surfaceDepth(sphere, {}, {0, 0}), 1.95, 1e-12);
    // This ray is the tangent from the origin to the ellipse.
    const double reach = 0.2 / std::sqrt(4 - 0.05 * 0.05);
    EXPECT_GT(surfaceDepth(sphere, {}, {reach - 1e-6, 0}), 1.9);
    EXPECT_EQ(surfaceDepth(sphere, {}, {reach + 1e-6, 0}), 0);
}

TEST(VirtualTruth, ARotatedBoxIsFirstHitAtItsEdge) {
    VirtualObject box = objectAt(VirtualShape::Box, {0, 0, 2});
    box.size.setConstant(0.2);
    box.T_world_object.rotation = Eigen::AngleAxisd(std::numbers::pi / 4, Eigen::Vector3d::UnitY());
    EXPECT_NEAR(surfaceDepth(box, {}, {0, 0}), 2 - 0.1 * std::numbers::sqrt2, 1e-12);
    EXPECT_EQ(surfaceDepth(box, {}, {0, 0.1}), 0);
    // The ray is parallel to the box's upper and lower sides, and passes outside the box.
    box.T_world_object.translation.y() = 0.2;
    EXPECT_EQ(surfaceDepth(box, {}, {0, 0}), 0);
}

TEST(VirtualTruth, AQuadIsFlatAndSeenFromBothSides) {
    VirtualObject quad = objectAt(VirtualShape::Quad, {0, 0, 2});
    quad.size.z() = 0;  // ignored, because a quad is flat
    EXPECT_NEAR(surfaceDepth(quad, {}, {0.09, 0.04}), 2, 1e-12);
    EXPECT_EQ(surfaceDepth(quad, {}, {0.09, 0.06}), 0);
    quad.T_world_object.rotation = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX());
    EXPECT_NEAR(surfaceDepth(quad, {}, {0.09, 0.04}), 2, 1e-12);
}

TEST(VirtualTruth, ObjectsBehindOrAroundTheCameraAreNotSeen) {
    for (const VirtualShape shape : {VirtualShape::Box, VirtualShape::Sphere, VirtualShape::Quad}) {
        EXPECT_EQ(surfaceDepth(objectAt(shape, {0, 0, -2}), {}, {0, 0}), 0);
        EXPECT_EQ(surfaceDepth(objectAt(shape, {0, 0, 0}), {}, {0, 0}), 0);
    }
}

TEST(VirtualTruth, NearerSurfacesOccludeOthers) {
    const CameraModel camera{{64, 48}, 60, 60, 31.5, 23.5, {}};
    const VirtualObject quad = objectAt(VirtualShape::Quad, {0, 0, 2});
    FloatImage real{{64, 48}, std::vector<float>(64 * 48)};
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 32; ++x)
            real.at(x, y) = 1 / (x < 29 ? 1.9F : x < 31 ? 2.1F : 2.3F);
    const VirtualTruth truth = virtualTruth(std::span(&quad, 1), camera, {}, real);
    EXPECT_EQ(cv::countNonZero(truth.silhouette), 12 * 6);
    EXPECT_EQ(cv::countNonZero(truth.visible), 9 * 6);
    EXPECT_EQ(cv::countNonZero(truth.undecided), 5 * 6);
    EXPECT_EQ(truth.visible.at<std::uint8_t>(24, 28), 0);
    EXPECT_EQ(truth.visible.at<std::uint8_t>(24, 29), 255);
}

}  // namespace
}  // namespace mfar::eval
