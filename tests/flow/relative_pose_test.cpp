#include "pipeline/epipolar/relative_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace mfar {
namespace {

constexpr double kFocal = 600;
constexpr double kDegree = 3.14159265358979323846 / 180;

Matrix6 priorCovariance(double turn, double shift) {
    Vector6 diagonal;
    diagonal << Eigen::Vector3d::Constant(turn * turn), Eigen::Vector3d::Constant(shift * shift);
    return diagonal.asDiagonal();
}

/// Matches between two views of random points. The true motion takes a point p to
/// exp(`motion`) p + `translation`. The prior pose has only the translation.
struct Case {
    Eigen::Vector3d translation{0.2, 0.02, 0.01};
    Vector6 motion = Vector6::Zero();
    double noise = 0.2;  // noise of a match [px]
    double wrong = 0;    // share of matches with an additional error of up to 0.02 in x/z and y/z
    int count = 250;

    [[nodiscard]] std::vector<RayMatch> matches() const {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> even(-1, 1);
        std::normal_distribution<double> normal(0, noise / kFocal);
        const RigidTransform M = exponential(motion);
        std::vector<RayMatch> out;
        for (int i = 0; i < count; ++i) {
            const Eigen::Vector2d ray(0.5 * even(random), 0.4 * even(random));
            const double z = 2.5 + 1.2 * even(random);
            const Eigen::Vector3d p = M * (z * ray.homogeneous()) + translation;
            Eigen::Vector2d seen = p.hnormalized();
            seen += Eigen::Vector2d(normal(random), normal(random));
            if (i < wrong * count) seen += 0.02 * Eigen::Vector2d(even(random), even(random));
            out.push_back({ray, seen});
        }
        return out;
    }
};

Vector6 motionOf(const Eigen::Vector3d& degrees, const Eigen::Vector3d& shift) {
    Vector6 out;
    out << degrees * kDegree, shift;
    return out;
}

const Matrix6 kUsualCovariance = priorCovariance(0.3 * kDegree, 0.005);

TEST(RelativePose, CorrectsAWrongRotationFromNoisyMatches) {
    for (const Eigen::Vector3d& t : {Eigen::Vector3d(0.2, 0.02, 0.01), Eigen::Vector3d(0, 0, 0.3),
                                     Eigen::Vector3d(0.05, -0.2, -0.3)}) {
        for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0.2, 0, 0), Eigen::Vector3d(0, 0, -0.3),
                                            Eigen::Vector3d(-0.15, 0.1, 0.2)}) {
            const Case c{.translation = t, .motion = motionOf(turn, {0, 0, 0})};
            const auto out = refineRelativePose(c.matches(), {t, kUsualCovariance}, kFocal);
            ASSERT_TRUE(out.accepted) << t.transpose() << " / " << turn.transpose();
            EXPECT_GT(out.normalBefore, 0.25);
            EXPECT_LT(out.normalAfter, 0.2);
            EXPECT_GT(out.inliers, 240);
            EXPECT_EQ(out.patches, 250);
        }
    }
}

TEST(RelativePose, CorrectsAWrongDirectionOfTranslation) {
    const Case c{.motion = motionOf({0, 0, 0}, {0, 0.02, 0.03})};
    const auto out =
        refineRelativePose(c.matches(), {c.translation, priorCovariance(1e-3, 0.03)}, kFocal);
    ASSERT_TRUE(out.accepted);
    EXPECT_LT(out.normalAfter, 0.2);
    const Eigen::Vector3d truth = c.translation + c.motion.tail<3>();
    const Eigen::Vector3d found = c.translation + out.motion.translation;
    EXPECT_LT(std::acos(found.normalized().dot(truth.normalized())), 0.6 * kDegree);
}

TEST(RelativePose, IsRobustToOutliers) {
    for (const double wrong : {0.2, 0.4}) {
        const Case c{.motion = motionOf({0.2, 0.05, -0.1}, {0, 0, 0}), .wrong = wrong};
        const auto out = refineRelativePose(c.matches(), {c.translation, kUsualCovariance}, kFocal);
        ASSERT_TRUE(out.accepted);
        const Eigen::Vector3d left =
            logarithm(out.motion.inverse() * exponential(c.motion)).head<3>() / kDegree;
        EXPECT_LT(std::abs(left.x()), 0.02);
        EXPECT_LT(std::abs(left.z()), 0.03);
    }
}

// Two pictures do not determine the length of the translation between them.
TEST(RelativePose, TranslationKeepsTheLengthOfThePrior) {
    const Case c{.motion = motionOf({0.2, 0, 0.1}, {0, 0, 0})};
    for (const double shift : {0.002, 0.02}) {
        const auto out = refineRelativePose(
            c.matches(), {c.translation, priorCovariance(0.3 * kDegree, shift)}, kFocal);
        ASSERT_TRUE(out.accepted);
        EXPECT_NEAR((c.translation + out.motion.translation).norm(), c.translation.norm(), 0.002);
    }
}

TEST(RelativePose, PureRotationIsRefinedFromBothComponentsOfMatches) {
    const Case c{.translation = {0, 0, 0}, .motion = motionOf({0.1, -0.2, 0.15}, {0, 0, 0})};
    const auto out =
        refineRelativePose(c.matches(), {c.translation, priorCovariance(0.3 * kDegree, 0)}, kFocal);
    ASSERT_TRUE(out.accepted);
    EXPECT_EQ(out.motion.translation.norm(), 0);
    const Vector6 left = logarithm(out.motion.inverse() * exponential(c.motion));
    EXPECT_LT(left.head<3>().norm(), 0.01 * kDegree);
}

TEST(RelativePose, AGoodPriorPoseIsKept) {
    for (const double noise : {1e-6, 0.3, 0.8}) {
        const Case c{.noise = noise};
        const auto out = refineRelativePose(c.matches(), {c.translation, kUsualCovariance}, kFocal);
        EXPECT_FALSE(out.accepted) << noise;
        EXPECT_EQ(out.normalAfter, out.normalBefore);
        EXPECT_EQ(out.motion.translation.norm(), 0);
    }
}

TEST(RelativePose, ThePriorPoseIsKeptIfMatchesAreFewOrDisagree) {
    Case c{.motion = motionOf({0.2, 0, 0}, {0, 0, 0})};
    const PosePrior prior{c.translation, kUsualCovariance};
    for (const int count : {0, 1, 5, 12}) {
        c.count = count;
        const auto out = refineRelativePose(c.matches(), prior, kFocal);
        EXPECT_FALSE(out.accepted);
        EXPECT_EQ(out.patches, count);
    }
    c.count = 250;
    c.wrong = 0.9;
    EXPECT_FALSE(refineRelativePose(c.matches(), prior, kFocal).accepted);
}

TEST(RelativePose, IsInvariantToTheUnitOfLength) {
    const Case c{.motion = motionOf({0.2, -0.05, 0.1}, {0.001, 0.002, 0})};
    const auto matches = c.matches();
    const auto metres = refineRelativePose(matches, {c.translation, kUsualCovariance}, kFocal);
    for (const double unit : {1e-6, 1e3}) {
        Vector6 scale = Vector6::Ones();
        scale.tail<3>().setConstant(unit);
        const Matrix6 covariance = scale.asDiagonal() * kUsualCovariance * scale.asDiagonal();
        const auto out = refineRelativePose(matches, {unit * c.translation, covariance}, kFocal);
        ASSERT_TRUE(out.accepted);
        EXPECT_NEAR(out.normalAfter, metres.normalAfter, 1e-9);
        EXPECT_LT((out.motion.translation / unit - metres.motion.translation).norm(), 1e-9);
        EXPECT_LT(out.motion.rotation.angularDistance(metres.motion.rotation), 1e-9);
    }
}

TEST(RelativePose, NonFiniteInputIsRefused) {
    const Case c{.motion = motionOf({0.2, 0, 0}, {0, 0, 0})};
    const auto matches = c.matches();
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_FALSE(refineRelativePose(matches, {{bad, 0, 0}, kUsualCovariance}, kFocal).accepted);
        Matrix6 covariance = kUsualCovariance;
        covariance(2, 2) = bad;
        EXPECT_FALSE(refineRelativePose(matches, {c.translation, covariance}, kFocal).accepted);
    }
    auto spoilt = matches;
    for (RayMatch& match : spoilt)
        match.still.x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(refineRelativePose(spoilt, {c.translation, kUsualCovariance}, kFocal).accepted);
    EXPECT_FALSE(refineRelativePose(matches, {c.translation, -kUsualCovariance}, kFocal).accepted);
}

TEST(RelativePose, SpreadOfAMatchIncludesTheUncertaintyOfRotationAndTranslation) {
    const Matrix6 turn = priorCovariance(0.01, 0), shift = priorCovariance(0, 0.02);
    const RayMatch far{{0, 0}, {0, 0}}, near{{0, 0}, {0.1, 0}};
    const Eigen::Vector3d t(0.2, 0, 0);
    EXPECT_NEAR(spreadOf(far, {t, turn})(1, 1), 1e-4, 1e-12);
    EXPECT_NEAR(spreadOf(far, {t, shift})(1, 1), 0, 1e-12);
    EXPECT_NEAR(spreadOf(near, {t, shift})(1, 1), 1e-4, 1e-12)
        << "a shift of 0.02 at depth 2 must give a spread of 0.01";
}

}  // namespace
}  // namespace mfar
