#include "tests/measure/eval/still_choice.h"

#include <gtest/gtest.h>

namespace mfar::eval {
namespace {

Recording withStillsAt(std::initializer_list<std::int64_t> times) {
    Recording out;
    for (const std::int64_t ns : times)
        out.stills.push_back({{ns}, {}});
    return out;
}

Pose poseAt(std::int64_t ns, double x) {
    return {{ns}, {Eigen::Quaterniond::Identity(), {x, 0, 0}}};
}

TEST(ReferenceStill, IsTheNearestInTimeOrTheEarlierOfTwoEquallyNear) {
    const Recording recording = withStillsAt({100, 200, 400});
    EXPECT_EQ(referenceStill(recording, {190}), 1U);
    EXPECT_EQ(referenceStill(recording, {150}), 0U);
    EXPECT_EQ(referenceStill(recording, {1000}), 2U);
    EXPECT_EQ(referenceStill(withStillsAt({}), {1}), std::nullopt);
}

TEST(SecondStill, IsTheNextNearestThatDoesNotShowTheFramesOwnView) {
    const Recording recording = withStillsAt({100, 200, 400});
    EXPECT_EQ(secondStill(recording, {190}), 0U);
    EXPECT_EQ(secondStill(recording, {150}), 1U);
    EXPECT_EQ(secondStill(recording, {200}), 2U)
        << "the still at 200 ns shows the frame's own view";
    EXPECT_EQ(secondStill(withStillsAt({100}), {1}), std::nullopt);
    EXPECT_EQ(secondStill(withStillsAt({100, 200}), {200}), std::nullopt);
}

TEST(ReferenceStill, WithoutABaselineTheStillOfTheSameTimeIsNotChosen) {
    const Recording recording = withStillsAt({100, 300});
    EXPECT_EQ(referenceStill(recording, {100}), 1U);
    EXPECT_EQ(referenceStill(withStillsAt({100}), {100}), std::nullopt);
}

TEST(ReferenceStill, WithABaselineTheStillOfTheSameTimeIsChosen) {
    Recording recording = withStillsAt({100, 300});
    recording.rig.T_still_video.translation = {-0.014, 0, 0};
    EXPECT_EQ(referenceStill(recording, {100}), 0U);
}

TEST(ReferenceStill, AStillWithTheFramesPoseIsNotChosen) {
    Recording recording = withStillsAt({100, 300});
    recording.poses = {poseAt(90, 0.5), poseAt(100, 0.5), poseAt(300, 0.7)};
    EXPECT_EQ(referenceStill(recording, {90}), 1U);
    recording.poses[0] = poseAt(90, 0.51);
    EXPECT_EQ(referenceStill(recording, {90}), 0U);
}

}  // namespace
}  // namespace mfar::eval
