#include "tests/measure/bench/workload.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace mfar::bench {
namespace {

double meanDifference(const cv::Mat& a, const cv::Mat& b) {
    return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

TEST(SyntheticWorkload, EveryFrameDiffersAndRepeatedCallsGiveTheSameFrames) {
    const Workload work = syntheticWorkload({160, 120}, {576, 432}, 4);
    ASSERT_EQ(work.frames.size(), 4U);
    EXPECT_EQ(work.frames[0].size(), cv::Size(160, 120));
    EXPECT_EQ(work.stills[0].size(), cv::Size(576, 432));
    for (std::size_t i = 1; i < 4; ++i)
        EXPECT_GT(meanDifference(work.frames[i], work.frames[i - 1]), 3);
    const Workload again = syntheticWorkload({160, 120}, {576, 432}, 4);
    EXPECT_EQ(meanDifference(work.frames[3], again.frames[3]), 0);
}

TEST(SyntheticWorkload, TheStillHasDetailThatTheVideoLacks) {
    const Workload work = syntheticWorkload({160, 120}, {576, 432}, 1);
    cv::Mat down, up;
    cv::resize(work.stills[0], down, {160, 120}, 0, 0, cv::INTER_AREA);
    cv::resize(down, up, {576, 432}, 0, 0, cv::INTER_CUBIC);
    EXPECT_GT(meanDifference(up, work.stills[0]), 5);
}

TEST(HandheldWorkload, HasThePosesOfEveryFrameAndTheStill) {
    const Workload work = handheldWorkload({160, 120}, {576, 432}, 3);
    ASSERT_EQ(work.frames.size(), 3U);
    ASSERT_EQ(work.framePoses.size(), 3U);
    ASSERT_EQ(work.stillPoses.size(), 1U);
    EXPECT_EQ(work.rig.video.size, Size(160, 120));
    EXPECT_EQ(work.frames[0].size(), cv::Size(160, 120));
    EXPECT_EQ(work.stills[0].size(), cv::Size(576, 432));
    const Workload rest = atRest(work, 0);
    for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(work.framePoses[i]);
        EXPECT_GT(work.framePoses[i]->time, work.stillPoses[0]->time);
        EXPECT_EQ(rest.framePoses[i]->time, work.framePoses[0]->time);
        if (i == 0) continue;
        const Pose &now = *work.framePoses[i], &before = *work.framePoses[i - 1];
        EXPECT_GT((now.T_world_video.translation - before.T_world_video.translation).norm(), 1e-5);
        EXPECT_GT(meanDifference(work.frames[i], work.frames[i - 1]), 0.5);
    }
}

TEST(AtRest, FramesAreEqualOrDifferByNoiseOnly) {
    const Workload moving = syntheticWorkload({160, 120}, {576, 432}, 3);
    const Workload still = atRest(moving, 0), noisy = atRest(moving, 2);
    EXPECT_EQ(meanDifference(still.frames[2], still.frames[0]), 0);
    // Mean absolute difference of two values with normal noise of sigma 2: 2 * 2 / sqrt(pi).
    EXPECT_NEAR(meanDifference(noisy.frames[2], noisy.frames[0]), 2.257, 0.15);
}

}  // namespace
}  // namespace mfar::bench
