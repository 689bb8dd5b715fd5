#include "tests/measure/eval/shot.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mfar::eval {
namespace {

Pose somePose(std::int64_t ns) {
    const Eigen::AngleAxisd turn(0.3, Eigen::Vector3d(1, 2, 3).normalized());
    return {{ns}, {Eigen::Quaterniond(turn), {1, -2, 3}}};
}

TEST(PosesOf, RecordedPosesAreUsedWithinTheirTimeRange) {
    Recording recording;
    recording.poses = {somePose(100), somePose(200)};
    const PosePair inside = posesOf(recording, {100}, {150});
    EXPECT_TRUE(inside.frame && inside.still);
    const PosePair beyond = posesOf(recording, {100}, {250});
    EXPECT_TRUE(beyond.frame && !beyond.still);
}

TEST(PosesOf, WithoutRecordedPosesAFrameHasAPoseOnlyAtTheStillsTime) {
    const PosePair equal = posesOf({}, {100}, {100});
    ASSERT_TRUE(equal.frame && equal.still);
    StereoRig rig;
    rig.T_still_video.translation = {-0.1, 0, 0};
    const RigidTransform relative = stillFromFrame(rig, *equal.frame, *equal.still);
    EXPECT_EQ(relative.translation, rig.T_still_video.translation);
    EXPECT_FALSE(posesOf({}, {100}, {101}).frame);
}

TEST(Turned, RotatesTheRelativePoseByExactlyTheGivenAngle) {
    StereoRig rig;
    rig.T_still_video = {Eigen::Quaterniond(0.9, 0.1, 0.2, 0.3).normalized(), {-0.1, 0, 0.02}};
    const Pose frame = somePose(100), still = {{50}, {}};
    const RigidTransform exact = stillFromFrame(rig, frame, still);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const RigidTransform off = stillFromFrame(rig, turned(frame, {0.2, seed}, "a"), still);
        EXPECT_NEAR(off.rotation.angularDistance(exact.rotation), 0.2 * std::numbers::pi / 180,
                    1e-9);
        EXPECT_NEAR((off.translation - exact.translation).norm(), 0, 1e-12);
        sum += (exact.rotation.conjugate() * off.rotation).vec().normalized();
    }
    EXPECT_LT(sum.norm() / 200, 0.2);  // directions are uniformly distributed, so the mean is small
}

TEST(Turned, EveryRecordingFrameAndSeedHasItsOwnRotationAxis) {
    const auto axis = [](std::int64_t ns, std::uint64_t seed, std::string_view recording) {
        const Pose still{{ns}, {}};
        return turned(still, {1, seed}, recording).T_world_video.rotation.vec().eval();
    };
    EXPECT_EQ(axis(1, 7, "a"), axis(1, 7, "a"));
    EXPECT_NE(axis(1, 7, "a"), axis(2, 7, "a"));
    EXPECT_NE(axis(1, 7, "a"), axis(1, 8, "a"));
    EXPECT_NE(axis(1, 7, "a"), axis(1, 7, "b"));
    EXPECT_NEAR(turned(somePose(1), {}, "a")
                    .T_world_video.rotation.angularDistance(somePose(1).T_world_video.rotation),
                0, 1e-9);
}

}  // namespace
}  // namespace mfar::eval
