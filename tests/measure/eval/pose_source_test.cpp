#include "hal/virtual/recorder.h"
#include "pipeline/track/tag_map.h"
#include "tests/measure/eval/pose_source.h"
#include "tests/track/tag_scene.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mfar::eval {
namespace {

using namespace test;

constexpr double kDistance = 0.5;
constexpr Timestamp kStillTime{1000 + 50'000'000};

const PlacedTag kOnlyTag{{TagFamily::Tag36h11, 12}, 0.1, {}};

Timestamp timeOf(int i) {
    return {1000 + 33'000'000LL * i};
}

RigidTransform standsAt(Timestamp time) {
    return cameraAt(kDistance, 0.4 + 0.004 * static_cast<double>(time.ns) / 33e6, -0.3, 0.1);
}

/// Four frames with tags, a still between two of them, then a frame without tags. The recorded
/// poses are wrong, so that the tests can tell them from poses found from tags.
Recording recordedIn(const std::filesystem::path& root) {
    const StereoRig rig{testCamera(), testCamera().scaledTo({1280, 960}), {}};
    Recorder recorder(root, rig, 30);
    for (int i = 0; i < 5; ++i) {
        const RigidTransform truth = standsAt(timeOf(i));
        const std::vector<PlacedTag> tags(i < 4 ? 1 : 0, kOnlyTag);
        EXPECT_TRUE(recorder.video(renderTags(rig.video, truth, tags).view(), timeOf(i)));
        EXPECT_TRUE(recorder.pose({timeOf(i), {}}));
    }
    EXPECT_TRUE(
        recorder.still(renderTags(rig.still, standsAt(kStillTime), {kOnlyTag}).view(), kStillTime));
    recorder.finish();
    writeFile(root / "tags.toml", "family = \"tag36h11\"\n[[tags]]\nid = 12\nsize = 0.1\n"
                                  "position = [0, 0, 0]\norientation = [1, 0, 0, 0]\n");
    return loadRecording(root);
}

void expectNear(const std::optional<Pose>& pose, Timestamp time) {
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->time, time);
    const RigidTransform truth = standsAt(time);
    EXPECT_LT(angleBetween(pose->T_world_video, truth), 0.3 * std::numbers::pi / 180);
    EXPECT_LT((pose->T_world_video.translation - truth.translation).norm(), 0.005 * kDistance);
}

TEST(KnownPoses, TagsGivePosesOfFramesAndStills) {
    const TempFolder folder;
    const Recording recording = recordedIn(folder / "tags");
    const KnownPoses poses(recording, PoseSource::Tags);
    for (int i = 0; i < 4; ++i) {
        const PosePair pair = poses.of(timeOf(i), kStillTime);
        expectNear(pair.frame, timeOf(i));
        expectNear(pair.still, kStillTime);
        EXPECT_EQ(pair.frame->tags, 1);
        EXPECT_GT(pair.frame->covariance.trace(), 0);
        EXPECT_GT(pair.still->covariance.trace(), 0);
    }
    const auto predicted = poses.of(timeOf(4), kStillTime).frame;
    ASSERT_TRUE(predicted);
    EXPECT_EQ(predicted->tags, 0);
    expectNear(poses.of(timeOf(1), timeOf(2)).still, timeOf(2));
    EXPECT_FALSE(poses.of({5}, {6}).frame);
    EXPECT_FALSE(poses.of({5}, {6}).still);
}

TEST(KnownPoses, GivesRecordedPosesOrNoneAsRequested) {
    const TempFolder folder;
    const Recording recording = recordedIn(folder / "recorded");
    const PosePair recorded = KnownPoses(recording, PoseSource::Recorded).of(timeOf(1), kStillTime);
    ASSERT_TRUE(recorded.frame && recorded.still);
    EXPECT_EQ(recorded.frame->T_world_video.translation.norm(), 0);
    const PosePair none = KnownPoses(recording, PoseSource::None).of(timeOf(1), kStillTime);
    EXPECT_FALSE(none.frame || none.still);
}

TEST(KnownPoses, PosesFromTagsNeedATagMap) {
    const TempFolder folder;
    const Recording recording = recordedIn(folder / "bare");
    std::filesystem::remove(folder / "bare" / "tags.toml");
    EXPECT_THROW(KnownPoses(recording, PoseSource::Tags), TagMapError);
    EXPECT_NO_THROW(KnownPoses(recording, PoseSource::None));
}

}  // namespace
}  // namespace mfar::eval
