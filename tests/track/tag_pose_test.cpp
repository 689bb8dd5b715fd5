#include "pipeline/track/pose_refine.h"
#include "pipeline/track/tag_pose.h"
#include "tests/track/tag_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace mfar {
namespace {

using namespace test;

TagObservation observe(const CameraModel& camera, const RigidTransform& T_world_camera,
                       const PlacedTag& tag) {
    return {tag.size, tag.T_world_tag, cornersOf(camera, T_world_camera, tag)};
}

class Noise {
public:
    explicit Noise(double sigma) : noise_(0, sigma) {}
    void addTo(TagObservation& tag) {
        for (Eigen::Vector2d& corner : tag.corners)
            corner += Eigen::Vector2d(noise_(random_), noise_(random_));
    }

private:
    std::mt19937 random_{7};
    std::normal_distribution<double> noise_;
};

RigidTransform randomView(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(-1, 1);
    const RigidTransform T = cameraAt(0.45 + 0.15 * unit(random), 0.9 * unit(random),
                                      0.9 * unit(random), 3 * unit(random));
    return T * RigidTransform{Eigen::Quaterniond::Identity(),
                              {0.05 * unit(random), 0.04 * unit(random), 0}};
}

const PlacedTag kTag{{TagFamily::Tag36h11, 0}, 0.08, {}};

std::vector<PlacedTag> page() {
    std::vector<PlacedTag> out;
    for (int i = 0; i < 4; ++i) {
        const Eigen::Vector3d place(i % 2 == 0 ? 0 : 0.1, i < 2 ? 0 : 0.1, 0);
        out.push_back({{TagFamily::Tag36h11, i}, 0.06, {Eigen::Quaterniond::Identity(), place}});
    }
    return out;
}

TEST(PlanarPoses, TheBestSolutionOfExactCornersIsTheTruePose) {
    std::mt19937 random(1);
    const CameraModel camera = testCamera();
    int two = 0;
    for (int i = 0; i < 300; ++i) {
        const RigidTransform truth = randomView(random);
        const TagObservation tag = observe(camera, truth, kTag);
        const auto poses = solveTagPose({&tag, 1}, camera);
        ASSERT_TRUE(poses);
        EXPECT_LT(angleBetween(poses->best.T_world_camera, truth), 1e-6);
        EXPECT_LT((poses->best.T_world_camera.translation - truth.translation).norm(), 1e-7);
        EXPECT_LT(poses->best.rms(), 1e-6);
        if (!poses->other) continue;
        ++two;
        EXPECT_GE(poses->other->squaredError, poses->best.squaredError);
    }
    EXPECT_GT(two, 250);
}

TEST(PlanarPoses, WithNoisyCornersOneOfTheTwoSolutionsIsNearTheTruth) {
    std::mt19937 random(2);
    Noise noise(0.3);
    const CameraModel camera = testCamera();
    for (int i = 0; i < 300; ++i) {
        const RigidTransform truth = randomView(random);
        TagObservation tag = observe(camera, truth, kTag);
        noise.addTo(tag);
        const auto poses = solveTagPose({&tag, 1}, camera);
        ASSERT_TRUE(poses);
        double nearest = angleBetween(poses->best.T_world_camera, truth);
        if (poses->other)
            nearest = std::min(nearest, angleBetween(poses->other->T_world_camera, truth));
        EXPECT_LT(nearest, 8 * kDegree) << i;
    }
}

TEST(TagPose, CovarianceMatchesTheErrors) {
    const CameraModel camera = testCamera();
    const RigidTransform truth = cameraAt(0.5, 0.5, 0.4, 0.2);
    Noise noise(0.2);
    const std::vector<PlacedTag> tags = page();
    constexpr int kRuns = 2000;
    Vector6 mean = Vector6::Zero();
    double distance = 0;
    for (int i = 0; i < kRuns; ++i) {
        std::vector<TagObservation> seen;
        for (const PlacedTag& tag : tags) {
            seen.push_back(observe(camera, truth, tag));
            noise.addTo(seen.back());
        }
        const auto poses = solveTagPose(seen, camera, {.cornerSigma = 0.2});
        ASSERT_TRUE(poses);
        const Vector6 error = logarithm(truth.inverse() * poses->best.T_world_camera);
        mean += error / kRuns;
        distance += error.dot(poses->best.covariance.ldlt().solve(error)) / kRuns;
    }
    // `distance` is the mean squared Mahalanobis distance of the errors. With the true covariance
    // it is 6 (one for each degree of freedom) with a standard error of 0.08. The limits allow a
    // covariance that is somewhat too large (smaller distance) more than one that is too small.
    EXPECT_GT(distance, 4.5);
    EXPECT_LT(distance, 6.4);
    EXPECT_LT(mean.head<3>().norm(), 0.05 * kDegree);
}

TEST(TagPose, PoseFromSeveralTagsIsMoreExactThanFromOne) {
    std::mt19937 random(4);
    Noise noise(0.2);
    const CameraModel camera = testCamera();
    double one = 0, all = 0;
    for (int i = 0; i < 50; ++i) {
        const RigidTransform truth = randomView(random);
        std::vector<TagObservation> seen;
        for (PlacedTag tag : page()) {
            tag.T_world_tag.translation -= Eigen::Vector3d(0.05, 0.05, 0);
            seen.push_back(observe(camera, truth, tag));
            noise.addTo(seen.back());
        }
        const auto few = solveTagPose({seen.data(), 1}, camera), many = solveTagPose(seen, camera);
        if (!few || !many) continue;
        one += (few->best.T_world_camera.translation - truth.translation).norm();
        all += (many->best.T_world_camera.translation - truth.translation).norm();
    }
    EXPECT_GT(one, 0);
    EXPECT_LT(all, 0.5 * one);
}

// Blur, gamma and ink move the edges of all tags outwards or inwards by the same distance, the edge
// shift (see refinePose()). With one tag, the edge shift has the same effect as a change of the
// tag's distance.
TEST(TagPose, EdgeShiftIsEstimatedFromSeveralTagsOnly) {
    const CameraModel camera = testCamera();
    const RigidTransform truth = cameraAt(0.5, 0.3, 0.2, 0.4);
    for (const double shift : {-0.3, 0., 0.3}) {
        std::vector<TagObservation> seen;
        for (const PlacedTag& tag : page()) {
            seen.push_back(observe(camera, truth, tag));
            const auto outwards = outwardsOf(seen.back().corners);
            for (int k = 0; k < 4; ++k)
                seen.back().corners[k] += shift * outwards[k];
        }
        const auto many = solveTagPose(seen, camera), one = solveTagPose({seen.data(), 1}, camera);
        ASSERT_TRUE(many && one);
        // The prior of the edge shift makes the estimate slightly smaller.
        EXPECT_NEAR(many->best.edgeShift, shift, 0.1 * std::abs(shift) + 1e-6);
        const auto error = [&](const CameraPoses& poses) {
            return (poses.best.T_world_camera.translation - truth.translation).norm();
        };
        EXPECT_LT(error(*many), 2e-4 + 1e-7);
        EXPECT_NEAR(one->best.edgeShift, 0, 1e-9);
        if (shift != 0) {
            EXPECT_GT(error(*one), 2e-3);
        }
    }
}

TEST(TagPose, CornersMovedByTheirOutwardVectorsMoveEveryEdgeByOnePixel) {
    const CameraModel camera = testCamera();
    const auto corners = cornersOf(camera, cameraAt(0.5, 0.6, 0.2, 0.4), kTag);
    const auto outwards = outwardsOf(corners);
    const Eigen::Vector2d middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d edge = (corners[(k + 1) % 4] - corners[k]).normalized();
        const Eigen::Vector2d normal(-edge.y(), edge.x());
        EXPECT_GT(normal.dot(corners[k] - middle), 0);
        EXPECT_NEAR(normal.dot(outwards[k]), 1, 1e-9);
        EXPECT_NEAR(normal.dot(outwards[(k + 1) % 4]), 1, 1e-9);
    }
}

TEST(TagPose, ATagThatContradictsTheOthersIsIgnored) {
    const CameraModel camera = testCamera();
    const RigidTransform truth = cameraAt(0.6, 0.4, -0.3);
    for (std::size_t wrong = 0; wrong < 4; ++wrong) {
        std::vector<TagObservation> seen;
        for (const PlacedTag& tag : page())
            seen.push_back(observe(camera, truth, tag));
        seen[wrong].T_world_tag.translation.x() += 0.03;
        const auto poses = solveTagPose(seen, camera);
        ASSERT_TRUE(poses);
        EXPECT_LT(angleBetween(poses->best.T_world_camera, truth), 1e-5);
        EXPECT_EQ(poses->best.tags, 3);
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_EQ(poses->used[i], i != wrong);
    }
}

TEST(TagPose, UnusableTagsGiveNoPose) {
    const CameraModel camera = testCamera();
    const auto refused = [&](const TagObservation& tag) {
        EXPECT_FALSE(solveTagPose({&tag, 1}, camera).has_value());
    };
    const TagObservation good = observe(camera, cameraAt(0.6, 0.3, 0.2), kTag);
    ASSERT_TRUE(solveTagPose({&good, 1}, camera).has_value());
    refused(observe(camera, cameraAt(0.6, 85 * kDegree, 0), kTag));  // refused: grazing angle
    refused(observe(camera, cameraAt(0.6, 3, 0), kTag));             // refused: seen from behind
    refused(observe(camera, cameraAt(9, 0.3, 0.2), kTag));           // refused: too small
    const RigidTransform aside{Eigen::Quaterniond::Identity(), {0.3, 0, -0.5}};
    refused(observe(camera, aside, kTag));  // refused: partly outside the picture
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
        TagObservation tag = good;
        tag.corners[2].y() = value;
        refused(tag);
        tag = good;
        tag.size = value > 0 && std::isfinite(value) ? -1 : value;
        refused(tag);
        tag = good;
        if (!std::isfinite(value)) tag.T_world_tag.translation.x() = value;
        if (!std::isfinite(value)) refused(tag);
    }
    for (const double length : {0.0, 1e-20, 0.5, 1.5, 1e20}) {
        TagObservation tag = good;
        tag.T_world_tag.rotation.coeffs() *= length;
        refused(tag);
    }
    TagObservation bent = good;
    bent.corners[1] = 0.3 * bent.corners[0] + 0.3 * bent.corners[2] + 0.4 * bent.corners[3];
    refused(bent);
    TagObservation point = good;
    point.corners.fill(good.corners[0]);
    refused(point);
    EXPECT_FALSE(solveTagPose({}, camera).has_value());
}

TEST(TagPose, AnyFourCornersGiveAFinitePoseOrNone) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> x(-20, 660), y(-20, 500);
    const CameraModel camera = testCamera();
    int solved = 0;
    for (int i = 0; i < 20000; ++i) {
        TagObservation tag{0.08, {}, {}};
        for (Eigen::Vector2d& corner : tag.corners)
            corner = {x(random), y(random)};
        const auto poses = solveTagPose({&tag, 1}, camera, {.farthestCorner = 1e9});
        if (!poses) continue;
        ++solved;
        ASSERT_TRUE(isFinite(poses->best.T_world_camera));
        ASSERT_TRUE(poses->best.covariance.allFinite());
        if (poses->other) {
            ASSERT_TRUE(isFinite(poses->other->T_world_camera));
        }
    }
    EXPECT_GT(solved, 100);
}

TEST(TagPose, TagSizesInMillimetresOrMetresGiveEqualPoses) {
    std::mt19937 random(5);
    const CameraModel camera = testCamera();
    Noise noise(0.3);
    for (int i = 0; i < 100; ++i) {
        const RigidTransform truth = randomView(random);
        std::vector<TagObservation> metres, millimetres;
        for (const PlacedTag& tag : page()) {
            metres.push_back(observe(camera, truth, tag));
            noise.addTo(metres.back());
            millimetres.push_back(metres.back());
            millimetres.back().size *= 1000;
            millimetres.back().T_world_tag.translation *= 1000;
        }
        const auto a = solveTagPose(metres, camera), b = solveTagPose(millimetres, camera);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        EXPECT_EQ(a->used, b->used);
        EXPECT_LT(angleBetween(a->best.T_world_camera, b->best.T_world_camera), 1e-7);
        EXPECT_LT(
            (1000 * a->best.T_world_camera.translation - b->best.T_world_camera.translation).norm(),
            1e-3);
        Vector6 unit;
        unit << 1, 1, 1, 1000, 1000, 1000;
        const Matrix6 scaled = unit.asDiagonal() * a->best.covariance * unit.asDiagonal();
        EXPECT_TRUE(scaled.isApprox(b->best.covariance, 1e-4));
    }
}

}  // namespace
}  // namespace mfar
