#include "base/se3.h"
#include "pipeline/track/pose_filter.h"
#include "tests/track/tag_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace mfar {
namespace {

using namespace std::chrono_literals;
using Outcome = PoseFilter::Outcome;

constexpr double kRate = 30;

Timestamp timeOf(int i) {
    return Timestamp::fromSeconds(5 + i / kRate);
}

Pose measured(const RigidTransform& T, Timestamp time, double angle = 0.002,
              double length = 0.002) {
    Pose out;
    out.time = time;
    out.T_world_video = T;
    out.covariance.diagonal() << Eigen::Vector3d::Constant(angle * angle),
        Eigen::Vector3d::Constant(length * length);
    out.tags = 1;
    return out;
}

/// A motion at constant velocity in the body's own coordinates: a helix.
RigidTransform helix(double seconds) {
    Vector6 twist;
    twist << 0.3, -0.2, 0.4, 0.1, 0.2, -0.15;
    return test::cameraAt(0.7, 0.3, 0.2) * exponential(seconds * twist);
}

RigidTransform noisy(const RigidTransform& T, std::mt19937& random, double angle, double length) {
    std::normal_distribution<double> unit(0, 1);
    Vector6 x;
    for (int k = 0; k < 6; ++k)
        x(k) = (k < 3 ? angle : length) * unit(random);
    return T * exponential(x);
}

Vector6 randomTwist(std::mt19937& random, double most) {
    std::uniform_real_distribution<double> uniform(-most, most);
    Vector6 out;
    for (int k = 0; k < 6; ++k)
        out(k) = uniform(random);
    return out;
}

TEST(Se3, LogarithmUndoesExponential) {
    std::mt19937 random(3);
    for (const double most : {1e-12, 1e-6, 1e-3, 0.5, 1.7})
        for (int i = 0; i < 50; ++i) {
            const Vector6 twist = randomTwist(random, most);
            EXPECT_LT((logarithm(exponential(twist)) - twist).norm(), 1e-12 + 1e-9 * most);
        }
}

TEST(Se3, ExponentialIsTheLimitOfSmallSteps) {
    std::mt19937 random(4);
    const Vector6 twist = randomTwist(random, 1);
    RigidTransform steps;
    for (int i = 0; i < 1024; ++i)
        steps = steps * exponential(twist / 1024);
    EXPECT_LT(logarithm(steps.inverse() * exponential(twist)).norm(), 1e-10);
}

TEST(Se3, AdjointMovesATwistThroughAPose) {
    std::mt19937 random(5);
    const RigidTransform T = exponential(randomTwist(random, 1));
    const Vector6 x = randomTwist(random, 0.3);
    const RigidTransform a = T * exponential(x), b = exponential(adjoint(T) * x) * T;
    EXPECT_LT(logarithm(a.inverse() * b).norm(), 1e-12);
}

TEST(PoseFilter, FollowsAConstantTwistExactlyAndPredictsIt) {
    PoseFilter filter;
    for (int i = 0; i < 90; ++i)
        filter.update(measured(helix(i / kRate), timeOf(i)), 0.7);
    for (const double ahead : {-0.05, 0., 0.033, 0.1, 0.3}) {
        const auto pose =
            filter.predict(timeOf(89) + std::chrono::nanoseconds(static_cast<long>(ahead * 1e9)));
        ASSERT_TRUE(pose);
        const Vector6 error = logarithm(helix(89 / kRate + ahead).inverse() * pose->T_world_video);
        EXPECT_LT(error.norm(), 1e-4) << ahead;
        EXPECT_EQ(pose->tags, 0);
    }
}

TEST(PoseFilter, SmoothsNoiseWithAConsistentCovariance) {
    std::mt19937 random(1);
    PoseFilter filter;
    double raw = 0, filtered = 0, normalised = 0;
    int count = 0;
    for (int i = 0; i < 600; ++i) {
        const RigidTransform truth = helix(i / kRate);
        const Pose pose = measured(noisy(truth, random, 0.01, 0.007), timeOf(i), 0.01, 0.007);
        ASSERT_NE(filter.update(pose, 0.7), Outcome::Rejected);
        if (i < 30) continue;
        const auto now = filter.predict(timeOf(i));
        ASSERT_TRUE(now);
        const Vector6 error = logarithm(truth.inverse() * now->T_world_video);
        raw += logarithm(truth.inverse() * pose.T_world_video).squaredNorm();
        filtered += error.squaredNorm();
        normalised += error.dot(now->covariance.ldlt().solve(error));
        ++count;
    }
    EXPECT_LT(filtered, 0.5 * raw);
    // The filter allows for acceleration, which this path lacks. So its covariance may be too large
    // but never too small.
    EXPECT_LT(normalised / count, 7);
    EXPECT_GT(normalised / count, 0.5);
}

TEST(PoseFilter, AnOutlierDoesNotChangeThePose) {
    PoseFilter filter;
    for (int i = 0; i < 30; ++i)
        filter.update(measured(helix(i / kRate), timeOf(i)), 0.7);
    RigidTransform wrong = helix(1);
    wrong.translation.x() += 0.2;
    EXPECT_EQ(filter.update(measured(wrong, timeOf(30)), 0.7), Outcome::Rejected);
    const auto pose = filter.predict(timeOf(30));
    ASSERT_TRUE(pose);
    EXPECT_LT((pose->T_world_video.translation - helix(1).translation).norm(), 1e-3);
    EXPECT_EQ(filter.update(measured(helix(31 / kRate), timeOf(31)), 0.7), Outcome::Accepted);
}

TEST(PoseFilter, OutliersThatContradictEachOtherAreNeverFollowed) {
    PoseFilter filter;
    for (int i = 0; i < 30; ++i)
        filter.update(measured(helix(i / kRate), timeOf(i)), 0.7);
    for (int i = 30; i < 40; ++i) {
        RigidTransform wrong = helix(i / kRate);
        wrong.translation[i % 3] += i % 2 == 0 ? 0.3 : -0.3;
        EXPECT_EQ(filter.update(measured(wrong, timeOf(i)), 0.7), Outcome::Rejected);
    }
    EXPECT_EQ(filter.update(measured(helix(40 / kRate), timeOf(40)), 0.7), Outcome::Accepted);
}

TEST(PoseFilter, ARealJumpIsFollowedAfterThreeFrames) {
    PoseFilter filter;
    for (int i = 0; i < 30; ++i)
        filter.update(measured(helix(i / kRate), timeOf(i)), 0.7);
    const auto jumped = [](int i) {
        RigidTransform T = helix(i / kRate);
        T.translation.x() += 0.5;
        return T;
    };
    EXPECT_EQ(filter.update(measured(jumped(30), timeOf(30)), 0.7), Outcome::Rejected);
    EXPECT_EQ(filter.update(measured(jumped(31), timeOf(31)), 0.7), Outcome::Rejected);
    EXPECT_EQ(filter.update(measured(jumped(32), timeOf(32)), 0.7), Outcome::Jumped);
    const auto pose = filter.predict(timeOf(32));
    ASSERT_TRUE(pose);
    EXPECT_LT((pose->T_world_video.translation - jumped(32).translation).norm(), 5e-3);
}

TEST(PoseFilter, PredictsALimitedNumberOfFrames) {
    PoseFilterOptions options;
    options.bridgeFrames = 5;
    options.bridge = 10s;
    PoseFilter filter(options);
    EXPECT_FALSE(filter.predict(timeOf(0)));
    for (int i = 0; i < 30; ++i)
        filter.update(measured(helix(i / kRate), timeOf(i)), 0.7);
    double before = 0;
    for (int i = 30; i < 35; ++i) {
        filter.missed();
        const auto pose = filter.predict(timeOf(i));
        ASSERT_TRUE(pose) << i;
        EXPECT_GT(pose->covariance.trace(), before);
        before = pose->covariance.trace();
    }
    filter.missed();
    EXPECT_FALSE(filter.predict(timeOf(35)));
    EXPECT_EQ(filter.update(measured(helix(2), timeOf(60)), 0.7), Outcome::Started);
    EXPECT_TRUE(filter.predict(timeOf(60)));
}

TEST(PoseFilter, PredictsForALimitedTime) {
    PoseFilter filter;
    filter.update(measured(helix(0), timeOf(0)), 0.7);
    EXPECT_TRUE(filter.predict(timeOf(0) + 399ms));
    EXPECT_FALSE(filter.predict(timeOf(0) + 401ms));
    EXPECT_FALSE(filter.predict(timeOf(0) - 401ms));
    EXPECT_EQ(filter.update(measured(helix(9), timeOf(0) + 2s), 0.7), Outcome::Started);
}

TEST(PoseFilter, ATimeThatDoesNotIncreaseRestartsTheFilter) {
    PoseFilter filter;
    filter.update(measured(helix(1), timeOf(30)), 0.7);
    EXPECT_EQ(filter.update(measured(helix(0), timeOf(30)), 0.7), Outcome::Started);
    EXPECT_EQ(filter.update(measured(helix(0), timeOf(29)), 0.7), Outcome::Started);
}

TEST(PoseFilter, InvalidPosesAndOptionsAreRefused) {
    PoseFilter filter;
    Pose pose = measured(helix(0), timeOf(0));
    pose.T_world_video.translation.x() = std::nan("");
    EXPECT_EQ(filter.update(pose, 0.7), Outcome::Rejected);
    pose = measured(helix(0), timeOf(0));
    pose.covariance(0, 0) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(filter.update(pose, 0.7), Outcome::Rejected);
    EXPECT_EQ(filter.update(measured(helix(0), timeOf(0)), 0), Outcome::Rejected);
    EXPECT_FALSE(filter.predict(timeOf(0)));
    PoseFilterOptions options;
    options.gate = std::nan("");
    EXPECT_THROW(PoseFilter{options}, std::invalid_argument);
}

}  // namespace
}  // namespace mfar
