#include "pipeline/track/pose_estimator.h"
#include "tests/track/tag_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mfar {
namespace {

using namespace test;

const PlacedTag kBareTag{{TagFamily::Tag36h11, 0}, 0.08, {}};

Timestamp momentOf(int i) {
    return Timestamp::fromSeconds(1 + i / 30.);
}

RigidTransform hand(int i, double tiltDeg, double offsetDeg) {
    const double t = i / 30.;
    const auto sway = [&](double phase) {
        return 0.6 * std::sin(1.9 * t + phase) + 0.3 * std::sin(4.3 * t + 2 * phase) +
               0.1 * std::sin(11 * t + 3 * phase);
    };
    return cameraAt(0.6 + 0.02 * sway(0.4), (offsetDeg + tiltDeg * sway(1)) * kDegree,
                    (0.7 * offsetDeg + tiltDeg * sway(2)) * kDegree, 0.3 + 0.05 * sway(3)) *
           RigidTransform{Eigen::Quaterniond::Identity(), {0.02 * sway(4), 0.02 * sway(5), 0}};
}

class Corners {
public:
    explicit Corners(double sigma, double unit = 1) : noise_(0, sigma), unit_(unit) {}
    TagObservation of(const CameraModel& camera, const RigidTransform& T_world_camera) {
        TagObservation out{kBareTag.size * unit_, kBareTag.T_world_tag,
                           cornersOf(camera, T_world_camera, kBareTag)};
        for (Eigen::Vector2d& corner : out.corners)
            corner += Eigen::Vector2d(noise_(random_), noise_(random_));
        return out;
    }

private:
    std::mt19937 random_{11};
    std::normal_distribution<double> noise_;
    double unit_;
};

/// Results of a run. `turns`: number of frames at which the pose's error in rotation changes by
/// more than 3 degrees. `flips`: result of PoseEstimator::flips(). `lost`: number of frames without
/// a pose. `worst`: largest error in rotation [rad].
struct Followed {
    int turns = 0, flips = 0, lost = 0;
    double worst = 0;
};

Followed follow(double tiltDeg, double offsetDeg, double sigma, int frames) {
    const CameraModel camera = testCamera();
    PoseEstimatorOptions options;
    options.tagPose.cornerSigma = std::max(sigma, options.tagPose.cornerSigma);
    PoseEstimator estimator(options);
    Corners corners(sigma);
    Followed out;
    std::optional<RigidTransform> before;
    for (int i = 0; i < frames; ++i) {
        const RigidTransform truth = hand(i, tiltDeg, offsetDeg);
        const TagObservation tag = corners.of(camera, truth);
        const auto pose = estimator.update({&tag, 1}, camera, momentOf(i));
        out.lost += pose ? 0 : 1;
        if (!pose) continue;
        const RigidTransform error = truth.inverse() * pose->T_world_video;
        if (before && angleBetween(*before, error) > 3 * kDegree) ++out.turns;
        before = error;
        out.worst = std::max(out.worst, angleBetween(truth, pose->T_world_video));
    }
    out.flips = estimator.flips();
    return out;
}

TEST(PoseEstimator, ThePoseDoesNotFlipInAThousandFramesOfATagSeenNearlyFromTheFront) {
    for (const double offset : {0., 2., 5.})
        for (const double sigma : {0.05, 0.1, 0.15}) {
            const Followed run = follow(3, offset, sigma, 1000);
            EXPECT_EQ(run.turns, 0) << offset << ' ' << sigma;
            EXPECT_EQ(run.flips, 0) << offset << ' ' << sigma;
            EXPECT_EQ(run.lost, 0);
            EXPECT_LT(run.worst, 15 * kDegree) << offset << ' ' << sigma;
        }
}

TEST(PoseEstimator, ThePoseIsStableWhileATagIsSeenObliquely) {
    const Followed run = follow(5, 35, 0.1, 300);
    EXPECT_EQ(run.turns, 0);
    EXPECT_EQ(run.flips, 0);
    EXPECT_LT(run.worst, 1 * kDegree);
}

TEST(PlanarChoice, AWrongPlanarSolutionIsCorrectedWithinAHundredFrames) {
    const CameraModel camera = testCamera();
    const RigidTransform truth = cameraAt(0.6, 0.3, 0.2);
    Corners corners(0.1);
    const TagObservation tag = corners.of(camera, truth);
    const auto poses = solveTagPose({&tag, 1}, camera);
    ASSERT_TRUE(poses && poses->other);
    ASSERT_LT(angleBetween(poses->best.T_world_camera, truth), 3 * kDegree);
    PlanarChoice choice;
    const RigidTransform wrong = poses->other->T_world_camera;
    int frames = 0;
    while (frames < 100 && &choice.choose(*poses, wrong) != &poses->best)
        ++frames;
    EXPECT_LT(frames, 100);
    EXPECT_TRUE(choice.flipped());
    EXPECT_EQ(&choice.choose(*poses, truth), &poses->best);
    EXPECT_FALSE(choice.flipped());
}

TEST(PlanarChoice, WithSimilarErrorsTheSolutionNearThePredictionIsKept) {
    CameraPoses poses;
    poses.best.T_world_camera = cameraAt(0.6, 0.05, 0);
    poses.best.squaredError = 0.02;
    poses.other = poses.best;
    poses.other->T_world_camera = cameraAt(0.6, -0.05, 0);
    poses.other->squaredError = 0.03;
    PlanarChoice choice;
    EXPECT_EQ(&choice.choose(poses, std::nullopt), &poses.best);
    for (int i = 0; i < 1000; ++i)
        ASSERT_EQ(&choice.choose(poses, cameraAt(0.6, -0.05, 0)), &*poses.other) << i;
}

TEST(PoseEstimator, TagSizesInMillimetresOrMetresGiveTheSameMotion) {
    const CameraModel camera = testCamera();
    PoseEstimator metres, millimetres;
    Corners a(0.15), b(0.15, 1000);
    for (int i = 0; i < 200; ++i) {
        const RigidTransform truth = hand(i, 6, 4);
        const TagObservation tagA = a.of(camera, truth), tagB = b.of(camera, truth);
        const bool seen = i % 17 != 0;
        const auto poseA = metres.update({&tagA, seen ? 1U : 0U}, camera, momentOf(i));
        const auto poseB = millimetres.update({&tagB, seen ? 1U : 0U}, camera, momentOf(i));
        ASSERT_EQ(poseA.has_value(), poseB.has_value()) << i;
        if (!poseA) continue;
        ASSERT_LT(angleBetween(poseA->T_world_video, poseB->T_world_video), 1e-6) << i;
        ASSERT_LT(
            (poseA->T_world_video.translation - poseB->T_world_video.translation / 1000).norm(),
            1e-6);
    }
    EXPECT_EQ(metres.flips(), millimetres.flips());
}

TEST(PoseEstimator, PosesArePredictedInShortGapsButNotInLongOnes) {
    const CameraModel camera = testCamera();
    PoseEstimator estimator;
    Corners corners(0.05);
    for (int i = 0; i < 30; ++i) {
        const TagObservation tag = corners.of(camera, hand(i, 3, 30));
        ASSERT_TRUE(estimator.update({&tag, 1}, camera, momentOf(i)));
        ASSERT_TRUE(estimator.raw());
    }
    for (int i = 30; i < 34; ++i) {
        const auto pose = estimator.update({}, camera, momentOf(i));
        ASSERT_TRUE(pose);
        EXPECT_FALSE(estimator.raw());
        EXPECT_EQ(pose->tags, 0);
        EXPECT_LT(angleBetween(pose->T_world_video, hand(i, 3, 30)), 2 * kDegree);
    }
    EXPECT_FALSE(estimator.update({}, camera, momentOf(60)));
}

TEST(PoseEstimator, TagsInAStillGiveThePoseOfTheVideoCamera) {
    const CameraModel still = testCamera().scaledTo({2304, 1728});
    const RigidTransform T_still_video{
        Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitY())), {-0.014, 0, 0}};
    const RigidTransform T_world_video = cameraAt(0.5, 0.4, 0.3);
    Corners corners(0.05);
    const TagObservation tag = corners.of(still, T_world_video * T_still_video.inverse());
    const PoseEstimator estimator;
    const auto pose = estimator.measure({&tag, 1}, still, T_still_video, momentOf(0));
    ASSERT_TRUE(pose);
    const Vector6 error = logarithm(T_world_video.inverse() * pose->T_world_video);
    EXPECT_LT(error.norm(), 0.01);
    EXPECT_LT(error.dot(pose->covariance.ldlt().solve(error)), 25);
}

}  // namespace
}  // namespace mfar
