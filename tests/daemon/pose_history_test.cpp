#include "base/se3.h"
#include "daemon/pose_history.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

constexpr double kInterval = 1. / 30;

/// A constant velocity in the camera's own frame [rad/s, m/s].
const Vector6 kTwist{{0.3, -0.2, 0.5, 0.4, 0.1, -0.3}};

Timestamp timeOf(double frame) {
    return Timestamp::fromSeconds(100 + frame * kInterval);
}

Pose steady(double frame) {
    Pose pose;
    pose.time = timeOf(frame);
    const RigidTransform start{Eigen::Quaterniond(0.8, 0.6, 0, 0), {1, 2, 3}};
    pose.T_world_video = start * exponential(frame * kInterval * kTwist);
    pose.covariance.diagonal().setConstant(1e-6);
    pose.tags = 4;
    return pose;
}

double distance(const Pose& a, const Pose& b) {
    return logarithm(a.T_world_video.inverse() * b.T_world_video).norm();
}

TEST(PoseHistory, ASteadyMotionIsInterpolatedExactly) {
    PoseHistory history;
    for (int i = 0; i < 5; ++i)
        history.add(steady(i));
    for (const double frame : {0.25, 1.5, 3.9}) {
        const std::optional<Pose> found = history.at(timeOf(frame));
        ASSERT_TRUE(found) << frame;
        EXPECT_LT(distance(*found, steady(frame)), 1e-6) << frame;
        EXPECT_EQ(found->time, timeOf(frame));
        EXPECT_EQ(found->tags, 0);
        EXPECT_LT((found->covariance - steady(0).covariance).norm(), 1e-9);
    }
}

TEST(PoseHistory, AtTheTimeOfAFrameThePoseEqualsThePoseOfTheFrame) {
    PoseHistory history;
    for (int i = 0; i < 5; ++i)
        history.add(steady(i));
    for (int i = 0; i < 5; ++i) {
        const std::optional<Pose> found = history.at(steady(i).time);
        ASSERT_TRUE(found) << i;
        EXPECT_LT(distance(*found, steady(i)), 1e-7) << i;
    }
}

TEST(PoseHistory, GivesNoPoseBeforeTheFirstOrAfterTheLastKnownPose) {
    PoseHistory history;
    EXPECT_FALSE(history.at(timeOf(0)));
    history.add(steady(0));
    history.add(steady(1));
    EXPECT_FALSE(history.at(timeOf(0.5))) << "two poses are too few to estimate the acceleration";
    history.add(steady(2));
    EXPECT_TRUE(history.at(timeOf(0.5)));
    EXPECT_FALSE(history.at(timeOf(-0.1)));
    EXPECT_FALSE(history.at(timeOf(2.1))) << "poses after the last one must not be extrapolated";
}

TEST(PoseHistory, PosesAreNotInterpolatedAcrossALongGap) {
    PoseHistory history;
    for (const int i : {0, 1, 2, 6, 7, 8})
        history.add(steady(i));
    EXPECT_TRUE(history.at(timeOf(1.5)));
    EXPECT_FALSE(history.at(timeOf(4)));
    EXPECT_TRUE(history.at(timeOf(6.5)));
}

TEST(PoseHistory, AChangeOfVelocityRaisesTheCovariance) {
    // Constant acceleration along x: 4 m/s^2.
    const auto accelerated = [](double frame) {
        Pose pose;
        pose.time = timeOf(frame);
        pose.T_world_video.translation.x() = 2 * frame * kInterval * frame * kInterval;
        return pose;
    };
    PoseHistory history;
    for (int i = 0; i < 4; ++i)
        history.add(accelerated(i));
    const Pose found = history.at(timeOf(1.5)).value();
    const double error = std::abs(found.T_world_video.translation.x() -
                                  accelerated(1.5).T_world_video.translation.x());
    EXPECT_GT(error, 1e-4);
    EXPECT_NEAR(std::sqrt(found.covariance(3, 3)), error, 1e-9)
        << "the standard deviation must equal the error of linear interpolation";
    EXPECT_EQ(found.covariance(4, 4), 0);
}

TEST(PoseHistory, OldPosesAreRemovedAndAStepBackInTimeRemovesAllPoses) {
    PoseHistory history;
    const int many = 3 * PoseHistory::kLength;
    for (int i = 0; i < many; ++i)
        history.add(steady(i));
    EXPECT_FALSE(history.at(timeOf(many - PoseHistory::kLength - 1.5)));
    EXPECT_TRUE(history.at(timeOf(many - PoseHistory::kLength + 0.5)));
    EXPECT_TRUE(history.at(timeOf(many - 1.5)));
    history.add(steady(10));
    EXPECT_FALSE(history.at(timeOf(many - 1.5)));
    history.add(steady(11));
    history.add(steady(12));
    EXPECT_TRUE(history.at(timeOf(10.5)));
}

TEST(PoseHistory, PosesInDifferentWorldFramesAreNotMixed) {
    PoseHistory history;
    for (int i = 0; i < 4; ++i)
        history.add(steady(i));
    const auto inOther = [](double frame) {
        Pose pose = steady(frame);
        pose.world = 1;
        return pose;
    };
    history.add(inOther(4));
    EXPECT_FALSE(history.at(timeOf(2.5)));
    EXPECT_FALSE(history.at(timeOf(3.5)));
    history.add(inOther(5));
    history.add(inOther(6));
    ASSERT_TRUE(history.at(timeOf(4.5)));
    EXPECT_EQ(history.at(timeOf(4.5))->world, 1);
}

}  // namespace
}  // namespace mfar
