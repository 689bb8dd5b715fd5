#include "daemon/exit_code.h"
#include "daemon/options.h"
#include "daemon/pose_config.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kTag = "family = \"tag36h11\"\n[[tags]]\nid = 3\nsize = 0.1\n"
                             "position = [0, 0, 1]\norientation = [1, 0, 0, 0]\n";

Failure fault(const test::TempFolder& folder) {
    Options options;
    options.config = folder.path() / "mfard.toml";
    options.source = "synthetic:flat";
    try {
        (void)usableConfig(options);
    } catch (const Failure& failure) {
        return failure;
    }
    return {ExitCode::Ok, ""};
}

TEST(PoseConfig, TheTagMapIsCheckedWithTheConfiguration) {
    const test::TempFolder folder;
    const std::string map = (folder.path() / "tags.toml").string();
    test::writeFile(folder.path() / "mfard.toml", "[pose]\ntags = \"tags.toml\"\n");
    EXPECT_EQ(fault(folder).code, ExitCode::NoInput);
    const std::string place = (folder / "mfard.toml").string() + ":2:8: pose.tags: ";
    EXPECT_THAT(fault(folder).what(), StartsWith(place + map + ": is missing"));

    test::writeFile(map, "[[tags]]\nid = 3\nsize = -1\n");
    EXPECT_EQ(fault(folder).code, ExitCode::BadData);
    EXPECT_THAT(fault(folder).what(), StartsWith(place + map + ":"));
    EXPECT_THAT(fault(folder).what(), testing::Not(HasSubstr("\n")));

    test::writeFile(map, kTag);
    EXPECT_EQ(fault(folder).code, ExitCode::Ok);
}

TEST(PoseConfig, WithRecordedPosesTheTagMapIsReadForTheObjects) {
    const test::TempFolder folder;
    test::writeFile(folder / "tags.toml", kTag);
    const PoseConfig recorded{PoseOrigin::Recorded, (folder / "tags.toml").string()};
    EXPECT_EQ(configuredTags(recorded).tags().size(), 1U);
}

TEST(PoseConfig, TheFamilyOfARosTagMapComesFromTheConfiguration) {
    const test::TempFolder folder;
    test::writeFile(folder / "tags.yaml", "standalone_tags: [{id: 4, size: 0.3}]");
    PoseConfig pose{PoseOrigin::Tags, folder / "tags.yaml", {TagFamily::Tag25h9}};
    EXPECT_NE(configuredTags(pose).find({TagFamily::Tag25h9, 4}), nullptr);
    pose.families.push_back(TagFamily::Tag36h11);
    EXPECT_THROW((void)configuredTags(pose), Failure);
}

TEST(PoseConfig, AnUnusedTagMapMayBeMissing) {
    const PoseConfig none{PoseOrigin::None, "/nonexistent/tags.toml"};
    EXPECT_TRUE(configuredTags(none).empty());
}

TEST(PoseConfig, RecordedPosesNeedARecording) {
    const test::TempFolder folder;
    test::writeFile(folder.path() / "mfard.toml", "[pose]\nsource = \"recorded\"\n");
    EXPECT_EQ(fault(folder).code, ExitCode::BadConfig);
    EXPECT_THAT(fault(folder).what(),
                HasSubstr("mfard.toml:2:10: pose.source: \"recorded\" needs a recording"));
}

TEST(PoseConfig, TheTrackerGetsTheOptionsOfTheConfiguration) {
    PoseConfig pose;
    pose.families = {TagFamily::Tag25h9};
    pose.tagSize = 0.25;
    pose.decimation = 1.5;
    pose.threads = 3;
    pose.fullSearchInterval = 7;
    pose.bridgeFrames = 60;
    const TrackerOptions options = trackerOptions(pose, tagMapFromToml(kTag, "t.toml"), 30);
    EXPECT_EQ(options.map.tags().size(), 1U);
    EXPECT_EQ(options.families, pose.families);
    EXPECT_EQ(options.tagSize, 0.25);
    EXPECT_EQ(options.decimation, 1.5);
    EXPECT_EQ(options.threads, 3);
    EXPECT_EQ(options.fullSearchInterval, 7);
    EXPECT_EQ(options.pose.filter.bridgeFrames, 60);
    EXPECT_GT(options.pose.filter.bridge, std::chrono::seconds(2)) << "60 frames at 30 Hz last 2 s";
}

}  // namespace
}  // namespace mfar
