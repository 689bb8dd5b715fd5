#include "hal/virtual/synthetic_truth.h"
#include "tests/measure/eval/flow_truth.h"
#include "tests/measure/eval/rig_resample.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace mfar::eval {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

StereoRig crookedRig() {
    StereoRig rig;
    rig.video = {{80, 60}, 70, 72, 39, 30, {-0.12, 0.03, 0.001, -0.002, 0}};
    rig.still = {{320, 240}, 290, 288, 161, 118, {0.08, -0.02, 0, 0.001, 0}};
    rig.T_still_video = {Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitY())),
                         {-0.05, 0.01, 0.002}};
    return rig;
}

FloatImage depthOf(Size size, float inverseDepth) {
    return {size,
            std::vector<float>(static_cast<std::size_t>(size.width) * size.height, inverseDepth)};
}

TEST(FlowTruth, FlowLeadsToTheStillPixelOfTheSamePoint) {
    const StereoRig rig = crookedRig();
    const RigidTransform motion{
        Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 1, 2).normalized())),
        {0.03, -0.02, 0.05}};
    const RigidTransform T_still_frame = rig.T_still_video * motion;
    const cv::Mat flow = flowOfInverseDepth(depthOf(rig.video.size, 0.8F), rig, T_still_frame);
    const cv::Mat map = stillMap(rig, rig.video.size);
    int known = 0;
    for (int y = 10; y < 50; ++y)
        for (int x = 10; x < 70; ++x) {
            const auto& v = flow.at<cv::Vec2f>(y, x);
            if (std::isnan(v[0])) continue;
            const cv::Mat place(1, 1, CV_32FC2, cv::Scalar(x + v[0], y + v[1]));
            cv::Mat q;
            cv::remap(map, q, place, {}, cv::INTER_LINEAR);
            const Eigen::Vector2d ray = rig.video.unproject({x, y});
            const Eigen::Vector3d point =
                T_still_frame * Eigen::Vector3d(ray.x() / 0.8, ray.y() / 0.8, 1 / 0.8);
            const Eigen::Vector2d wanted = rig.still.project(point.head<2>() / point.z());
            // Tolerance: remap interpolates at 1/32 px, and a video pixel is as wide as four still
            // pixels.
            EXPECT_NEAR(q.at<cv::Vec2f>(0)[0], wanted.x(), 0.15);
            EXPECT_NEAR(q.at<cv::Vec2f>(0)[1], wanted.y(), 0.15);
            ++known;
        }
    EXPECT_GT(known, 2000);
}

TEST(FlowTruth, FlowIsZeroAtInfinityAndUnknownWithoutDepth) {
    StereoRig rig = crookedRig();
    FloatImage depth = depthOf(rig.video.size, 0);
    depth.at(40, 30) = kUnknown;
    depth.at(41, 30) = -1;
    const cv::Mat flow = flowOfInverseDepth(depth, rig, rig.T_still_video);
    EXPECT_NEAR(cv::norm(flow.at<cv::Vec2f>(20, 30)), 0, 1e-4);
    EXPECT_TRUE(std::isnan(flow.at<cv::Vec2f>(30, 40)[0]));
    EXPECT_TRUE(std::isnan(flow.at<cv::Vec2f>(30, 41)[0]));
}

/// A panel at 1 m covers columns 30 to 49 of a wall at 2 m. The still camera is 0.1 m to the right
/// of the video camera.
TEST(FlowTruth, FlowOfPointsThatTheStillDoesNotShowIsUnknown) {
    StereoRig rig;
    rig.video = {{80, 60}, 100, 100, 39.5, 29.5, {}};
    rig.still = rig.video.scaledTo({240, 180});
    rig.T_still_video.translation = {-0.1, 0, 0};
    FloatImage depth = depthOf(rig.video.size, 0.5F);
    for (int y = 0; y < 60; ++y)
        for (int x = 30; x < 50; ++x)
            depth.at(x, y) = 1;
    const cv::Mat flow = flowOfInverseDepth(depth, rig, rig.T_still_video);
    // In the still, the wall moves 5 px to the left and partly out of the picture. The panel moves
    // 10 px, so it occludes 5 columns of the wall.
    for (int x = 0; x < 80; ++x) {
        const auto& v = flow.at<cv::Vec2f>(30, x);
        if (x < 5 || (x >= 25 && x < 30))
            EXPECT_TRUE(std::isnan(v[0])) << x;
        else
            EXPECT_NEAR(v[0], x >= 30 && x < 50 ? -10 : -5, 1e-4) << x;
    }
}

TEST(FlowTruth, ASlantedSurfaceDoesNotOccludeItself) {
    StereoRig rig;
    rig.video = {{80, 60}, 100, 100, 39.5, 29.5, {}};
    rig.still = rig.video;
    for (const double side : {-0.3, 0.3}) {
        rig.T_still_video.translation = {side, 0, 0.05};
        FloatImage depth = depthOf(rig.video.size, 0);
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 80; ++x)
                depth.at(x, y) = 0.2F + 0.015F * static_cast<float>(x);
        const cv::Mat flow = flowOfInverseDepth(depth, rig, rig.T_still_video);
        for (int x = 0; x < 80; ++x) {
            const auto& v = flow.at<cv::Vec2f>(30, x);
            const double inverseDepth = depth.at(x, 30);
            const double q =
                39.5 + ((x - 39.5) + 100 * side * inverseDepth) / (1 + 0.05 * inverseDepth);
            EXPECT_EQ(std::isnan(v[0]), q < -0.5 || q > 79.5) << x;
        }
    }
}

/// flowOfInverseDepth() finds occluded pixels by projecting depth. Rays through the exact scene
/// must give the same flow and the same occluded pixels.
TEST(FlowTruth, AgreesWithRaysThroughTheSyntheticScene) {
    using synthetic::Path;
    StereoRig rig = synthetic::boardRig();
    rig.video = rig.video.scaledTo({160, 120});
    for (const auto& [scene, path] : {std::pair(synthetic::Scene::Office, Path::Orbit),
                                      std::pair(synthetic::Scene::Shelf, Path::Forward)}) {
        const synthetic::World world = makeWorld(scene, 1);
        const RigidTransform T_world_frame = cameraPose(world, path, 1, 1.5);
        const RigidTransform T_world_still =
            cameraPose(world, path, 1, 0) * rig.T_still_video.inverse();
        RigidTransform T_world_turned = T_world_still;
        T_world_turned.rotation = T_world_still.rotation * rig.T_still_video.rotation;
        const synthetic::Viewpoint frame{rig.video, T_world_frame, 0};
        const FlowImage exact = flowBetween(world, frame, {rig.video, T_world_turned, 0});
        const cv::Mat flow = flowOfInverseDepth(inverseDepth(world, frame), rig,
                                                T_world_still.inverse() * T_world_frame);
        int both = 0, either = 0, far = 0;
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x) {
                const auto& ours = flow.at<cv::Vec2f>(y, x);
                const auto& wanted = exact.at(x, y);
                const bool a = !std::isnan(ours[0]), b = !std::isnan(wanted[0]);
                either += a || b;
                both += a && b;
                far += a && b && !(std::hypot(ours[0] - wanted[0], ours[1] - wanted[1]) < 1e-3);
            }
        EXPECT_EQ(far, 0);
        EXPECT_GT(both, 8000);
        // At silhouettes and at the border, a pixel's flow can be known in only one of the results.
        EXPECT_GT(both, 0.95 * either);
    }
}

}  // namespace
}  // namespace mfar::eval
