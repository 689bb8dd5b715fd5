#include "base/se3.h"
#include "daemon/tools/calibrate/pose_track.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar::test {
namespace {

using namespace calibration;

Timestamp at(double seconds) {
    return Timestamp::fromSeconds(seconds);
}

TEST(PoseTrack, UniformScrewMotionIsInterpolatedExactlyAtUnevenTimes) {
    const Vector6 twist = (Vector6() << 0.4, -0.7, 0.2, 0.1, 0.3, -0.2).finished();
    const RigidTransform start{Eigen::Quaterniond(0.6, 0, 0.8, 0), {1, 2, 3}};
    PoseTrack track;
    for (const double t : {0., 0.03, 0.07, 0.1, 0.14})
        track.add(at(t), start * exponential(twist * t));
    for (const double t : {0.03, 0.045, 0.0999}) {
        const auto pose = track.at(at(t));
        ASSERT_TRUE(pose);
        const RigidTransform expected = start * exponential(twist * t);
        EXPECT_LT(logarithm(pose->inverse() * expected).norm(), 1e-7) << t;
    }
}

TEST(PoseTrack, HandTremorIsInterpolatedToThousandthsOfADegree) {
    const auto pose = [](double t) {
        return RigidTransform{
            Eigen::Quaterniond(Eigen::AngleAxisd(
                0.3 * std::sin(3.1 * t) + 0.0006 * std::sin(36 * t), Eigen::Vector3d::UnitY())),
            {0, 0, 0.1 * std::sin(4 * t)}};
    };
    PoseTrack track;
    for (int i = 0; i < 60; ++i)
        track.add(at(i / 30.), pose(i / 30.));
    for (double t = 0.1; t < 1.8; t += 0.0137) {
        const auto found = track.at(at(t));
        ASSERT_TRUE(found);
        EXPECT_LT(found->rotation.angularDistance(pose(t).rotation), 6e-5) << t;
    }
}

TEST(PoseTrack, EndsOfTheTrackAndNeighboursOfAMissingFrameHaveNoPose) {
    PoseTrack track;
    EXPECT_FALSE(track.at(at(0)));
    for (const int i : {0, 1, 2, 3, 4, 6, 7, 8, 9, 10})
        track.add(at(i / 30.), {});
    const auto known = [&](double frame) { return track.at(at(frame / 30)).has_value(); };
    EXPECT_FALSE(known(-1));
    EXPECT_FALSE(known(0.5));
    EXPECT_TRUE(known(1.5));
    EXPECT_FALSE(known(3.5));
    EXPECT_FALSE(known(5));
    EXPECT_FALSE(known(6.5));
    EXPECT_TRUE(known(7.5));
    EXPECT_FALSE(known(9.5));
    EXPECT_FALSE(known(11));
    track.allowMissingFrames();
    EXPECT_TRUE(known(3.5));
    EXPECT_TRUE(known(5));
    EXPECT_FALSE(known(9.5));
}

TEST(PoseTrack, MissingFramesAreNoticedIfEveryThirdFrameIsMissing) {
    PoseTrack track;
    for (int i = 0; i < 60; ++i)
        if (i % 3 != 2) track.add(at(i / 30.), {});
    EXPECT_NEAR(track.interval(), 1 / 30., 1e-6);
    EXPECT_FALSE(track.at(at(30.5 / 30)));
    track.allowMissingFrames();
    EXPECT_TRUE(track.at(at(30.5 / 30)));
}

}  // namespace
}  // namespace mfar::test
