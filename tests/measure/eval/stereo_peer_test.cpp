#include "tests/measure/eval/flow_truth.h"
#include "tests/measure/eval/metrics/flow_error.h"
#include "tests/measure/eval/rectification.h"
#include "tests/measure/eval/stereo_peer.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace mfar::eval {
namespace {

using Eigen::Vector3d;

constexpr double kDistance = 2;

StereoRig crookedPairRig() {
    StereoRig rig;
    rig.video = {{160, 120}, 150, 152, 78, 61, {-0.1, 0.02, 0, 0, 0}};
    rig.still = {{480, 360}, 470, 470, 241, 178, {0.05, 0, 0, 0, 0}};
    rig.T_still_video = {Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Vector3d::UnitX())), {0, 0, 0}};
    return rig;
}

RigidTransform moved(double degrees, const Vector3d& axis, const Vector3d& translation) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(degrees * CV_PI / 180, axis.normalized())),
            translation};
}

cv::Mat pictureOfWall(const CameraModel& camera, const RigidTransform& T_camera_frame) {
    constexpr int kEdge = 700;
    constexpr double kPixel = 1.0 / 160;
    cv::Mat texture(kEdge, kEdge, CV_8UC3), map(camera.size.height, camera.size.width, CV_32FC2);
    cv::RNG(5).fill(texture, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(texture, texture, {}, 1);
    cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
    const RigidTransform T_frame_camera = T_camera_frame.inverse();
    for (int y = 0; y < map.rows; ++y)
        for (int x = 0; x < map.cols; ++x) {
            const Vector3d ray = T_frame_camera.rotation * camera.unproject({x, y}).homogeneous();
            const Vector3d& eye = T_frame_camera.translation;
            const Vector3d point = eye + ray * ((kDistance - eye.z()) / ray.z());
            map.at<cv::Vec2f>(y, x) = {static_cast<float>(point.x() / kPixel + kEdge / 2.0),
                                       static_cast<float>(point.y() / kPixel + kEdge / 2.0)};
        }
    cv::Mat out;
    cv::remap(texture, out, map, {}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
    return out;
}

FlowError errorAfter(const RigidTransform& motion,
                     StereoPeer::Matcher matcher = StereoPeer::Matcher::SemiGlobal) {
    const StereoRig rig = crookedPairRig();
    const RigidTransform T_still_frame = rig.T_still_video * motion;
    StereoPeer peer(rig, matcher);
    peer.setStill(pictureOfWall(rig.still, T_still_frame));
    const auto result = peer.run(pictureOfWall(rig.video, {}), T_still_frame);
    const FloatImage depth{rig.video.size, std::vector<float>(160 * 120, 1 / kDistance)};
    return flowError(result.flow, flowOfInverseDepth(depth, rig, T_still_frame));
}

TEST(StereoPeer, FindsTheFlowOfMotionsAcrossTheOpticalAxis) {
    for (const Vector3d& step : {Vector3d(-0.1, 0, 0), Vector3d(0.1, 0, 0), Vector3d(0, 0.1, 0),
                                 Vector3d(0.07, -0.06, 0.02)}) {
        const FlowError error = errorAfter(moved(3, {1, 2, 1}, step));
        EXPECT_GT(error.known, 10000U);
        EXPECT_EQ(error.coverage, 1);
        EXPECT_LT(error.bad1, 0.03) << step.transpose();
    }
}

TEST(StereoPeer, StereoBmFindsTheFlowOfAMotionAcrossTheOpticalAxis) {
    const FlowError error =
        errorAfter(moved(3, {1, 2, 1}, {-0.1, 0, 0}), StereoPeer::Matcher::Block);
    EXPECT_GT(error.coverage, 0.9);  // rows within half a block of the border have no result
    EXPECT_LT(error.epe, 0.3);
}

TEST(StereoPeer, HasNoResultWithoutEnoughMotionAcrossTheOpticalAxis) {
    EXPECT_EQ(errorAfter(moved(3, {1, 2, 1}, {0, 0, 0})).coverage, 0);
    EXPECT_EQ(errorAfter(moved(0, {1, 0, 0}, {0, 0, -0.2})).coverage, 0);
    EXPECT_EQ(errorAfter(moved(0, {1, 0, 0}, {0.05, 0, 0.2})).coverage, 0);
}

TEST(Rectification, APointHasTheSameRowInBothViewsAndMovesLeftByItsDisparity) {
    const CameraModel camera = crookedPairRig().video;
    const RigidTransform motion = moved(4, {1, -1, 2}, {0.03, 0.1, -0.02});
    const auto views = Rectification::of(camera, motion, 32);
    ASSERT_TRUE(views);
    for (const double depth : {0.7, 2.0, 50.0})
        for (int y = 5; y < 120; y += 22)
            for (int x = 5; x < 160; x += 25) {
                const Eigen::Vector2d place = views->ofFirst({x, y});
                EXPECT_GE(place.x(), 32);
                EXPECT_LT(place.y(), views->size().height);
                const Vector3d point = motion * (depth * camera.unproject({x, y}).homogeneous());
                const Eigen::Vector2d seen = camera.project(point.head<2>() / point.z());
                // There must be a disparity d for which toSecond() returns the point's position in
                // the second view.
                double best = 1e9;
                for (double d = 0; d < 40; d += 0.01)
                    best = std::min(best,
                                    (views->toSecond(place - Eigen::Vector2d(d, 0)) - seen).norm());
                EXPECT_LT(best, 0.01);
            }
}

TEST(Rectification, AlreadyRectifiedViewsAreOnlyPaddedOnTheLeft) {
    CameraModel camera = crookedPairRig().video;
    camera.distortion = {};
    camera.fy = camera.fx;
    const auto views =
        Rectification::of(camera, {Eigen::Quaterniond::Identity(), {-0.1, 0, 0}}, 16);
    ASSERT_TRUE(views);
    EXPECT_EQ(views->size(), cv::Size(160 + 16, 120));
    EXPECT_NEAR((views->ofFirst({3, 4}) - Eigen::Vector2d(19, 4)).norm(), 0, 1e-9);
    EXPECT_NEAR((views->toSecond({19, 4}) - Eigen::Vector2d(3, 4)).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace mfar::eval
