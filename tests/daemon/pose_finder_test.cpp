#include "daemon/exit_code.h"
#include "daemon/pose_finder.h"
#include "tests/track/tag_scene.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using namespace test;

const StereoRig kRig{testCamera(), testCamera().scaledTo({1152, 864}), {}};
const PlacedTag kPlacedTag{{TagFamily::Tag36h11, 4}, 0.1, {}};

PoseInputs inputs() {
    return {
        "bench", kRig, 30, TagMap({{kPlacedTag.tag, kPlacedTag.size, kPlacedTag.T_world_tag}}), {}};
}

RigidTransform view(double frame) {
    return cameraAt(0.6, 0.3 + 0.004 * frame, 0.2 - 0.006 * frame);
}

Timestamp frameTime(double frame) {
    return Timestamp::fromSeconds(2 + frame / 30);
}

struct Shot {
    Shot(const CameraModel& camera, double at, bool withTag)
        : picture(withTag ? renderTags(camera, view(at), {kPlacedTag})
                          : GrayPicture(camera.size, 90)),
          frame(picture.view(), frameTime(at), nullptr) {}
    GrayPicture picture;
    Frame frame;
};

std::optional<Pose> video(PoseFinder& finder, double at, bool withTag = true) {
    return finder.ofVideo(Shot(kRig.video, at, withTag).frame);
}

std::optional<Pose> still(PoseFinder& finder, double at, bool withTag) {
    const Shot shot(kRig.still, at, withTag);
    return finder.place(finder.measure(shot.frame), shot.frame.time());
}

double rotationError(const Pose& pose, double at) {
    return angleBetween(pose.T_world_video, view(at));
}

TEST(PoseFinder, TagsGiveFramesAndStillsTheirPose) {
    Stats stats;
    PoseFinder finder({}, inputs(), stats);
    EXPECT_EQ(finder.description(), "poses from a map of 1 tag");
    for (int i = 0; i < 4; ++i)
        EXPECT_LT(rotationError(video(finder, i).value(), i), 0.01) << i;
    const std::optional<Pose> sharp = still(finder, 2.5, true);
    ASSERT_TRUE(sharp);
    EXPECT_GT(sharp->tags, 0);
    EXPECT_LT(rotationError(*sharp, 2.5), 0.005);
    const PoseCounts counts = stats.count().poses;
    EXPECT_EQ(counts.frames, 4U);
    EXPECT_EQ(counts.measured, 4U);
    EXPECT_EQ(counts.stillsMeasured, 1U);
    EXPECT_EQ(counts.ms.count(), 4U);
}

TEST(PoseFinder, ThePoseOfAStillWithoutTagsIsInterpolatedBetweenFrames) {
    Stats stats;
    PoseFinder finder({}, inputs(), stats);
    for (int i = 0; i < 4; ++i)
        (void)video(finder, i);
    const std::optional<Pose> between = still(finder, 1.5, false);
    ASSERT_TRUE(between);
    EXPECT_EQ(between->tags, 0);
    EXPECT_LT(rotationError(*between, 1.5), 0.01);
    EXPECT_FALSE(still(finder, -1, false)) << "there is no pose before the first frame";
    const PoseCounts counts = stats.count().poses;
    EXPECT_EQ(counts.stills, 2U);
    EXPECT_EQ(counts.stillsTracked, 1U);
    EXPECT_EQ(counts.stillsMeasured, 0U);
}

TEST(PoseFinder, StillPosesAreInterpolatedOnlyBetweenMeasuredPoses) {
    Stats stats;
    PoseFinder finder({}, inputs(), stats);
    for (int i = 0; i < 3; ++i)
        (void)video(finder, i);
    for (int i = 3; i < 6; ++i)
        EXPECT_TRUE(video(finder, i, false))
            << "a short loss of the tags must be bridged by prediction";
    EXPECT_FALSE(still(finder, 4.5, false));
    EXPECT_EQ(stats.count().poses.tracked, 6U);
    EXPECT_EQ(stats.count().poses.measured, 3U);
}

TEST(PoseFinder, PredictionOfPosesWithoutTagsCanBeDisabled) {
    Stats stats;
    PoseConfig config;
    config.bridgeFrames = 0;
    PoseFinder finder(config, inputs(), stats);
    EXPECT_TRUE(video(finder, 0));
    EXPECT_FALSE(video(finder, 1, false));
}

TEST(PoseFinder, WithoutATagMapTheFirstTagIsTheOriginOfTheWorld) {
    Stats stats;
    PoseInputs unknown = inputs();
    unknown.tags = {};
    PoseFinder finder({}, unknown, stats);
    EXPECT_EQ(finder.description(), "poses from the first tag, whose edge is 0.1 m");
    EXPECT_TRUE(finder.mayFindTags());
    EXPECT_FALSE(video(finder, 0, false));
    EXPECT_FALSE(finder.takeFoundTags());
    const Pose pose = video(finder, 1).value();
    EXPECT_LT(angleBetween(standOnTag() * pose.T_world_video, view(1)), 0.01);
    EXPECT_FALSE(finder.isRecordable(pose))
        << "another tag may still become the origin of the world";
    for (int i = 2; i < 6; ++i) {
        EXPECT_FALSE(finder.takeFoundTags()) << "one frame may be a false detection";
        EXPECT_TRUE(video(finder, i));
    }
    EXPECT_TRUE(finder.isRecordable(pose));
    const std::optional<TagMap> found = finder.takeFoundTags();
    ASSERT_TRUE(found);
    EXPECT_NE(found->find(kPlacedTag.tag), nullptr);
    (void)video(finder, 6);
    EXPECT_FALSE(finder.takeFoundTags()) << "the found tags must be returned only once";
}

TEST(PoseFinder, RecordedPosesAreUsedUnchanged) {
    Stats stats;
    PoseConfig config;
    config.source = PoseOrigin::Recorded;
    PoseInputs recording = inputs();
    recording.recorded = [](Timestamp t) -> std::optional<Pose> {
        if (t < frameTime(1)) return std::nullopt;
        return Pose{.time = t,
                    .T_world_video = {Eigen::Quaterniond::Identity(), {0, 0, t.seconds()}}};
    };
    PoseFinder finder(config, recording, stats);
    EXPECT_FALSE(video(finder, 0))
        << "only recorded poses may be used, although the tag is visible";
    EXPECT_EQ(video(finder, 2).value().T_world_video.translation.z(), frameTime(2).seconds());
    EXPECT_EQ(still(finder, 1.5, true).value().T_world_video.translation.z(),
              frameTime(1.5).seconds());
    const PoseCounts counts = stats.count().poses;
    EXPECT_EQ(counts.tracked, 1U);
    EXPECT_EQ(counts.stillsTracked, 1U);
    EXPECT_EQ(counts.tracker.frames, 0) << "tags must not be searched";
    EXPECT_EQ(counts.ms.count() + counts.stillMs.count(), 0U);
}

TEST(PoseFinder, ASourceWithoutPosesIsReported) {
    Stats stats;
    PoseConfig config;
    config.source = PoseOrigin::Recorded;
    try {
        const PoseFinder finder(config, inputs(), stats);
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code, ExitCode::BadData);
        EXPECT_THAT(failure.what(), testing::StartsWith("bench: has no poses"));
    }
}

TEST(PoseFinder, WithPoseSourceNoneNoTrackerRuns) {
    Stats stats;
    PoseConfig config;
    config.source = PoseOrigin::None;
    PoseFinder finder(config, inputs(), stats);
    EXPECT_FALSE(video(finder, 0));
    EXPECT_FALSE(still(finder, 0, true));
    EXPECT_EQ(stats.count().poses.frames, 0U);
    EXPECT_EQ(finder.description(), "no poses");
}

}  // namespace
}  // namespace mfar
