#include "hal/virtual/recording.h"
#include "tests/unit/damage.h"
#include "tests/unit/small_recording.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <functional>
#include <random>
#include <string>

namespace mfar {
namespace {

namespace fs = std::filesystem;
using test::replaceInFile;
using test::TempFolder;
using test::writeFile;

std::string faultOf(const fs::path& root) {
    try {
        static_cast<void>(loadRecording(root));
    } catch (const RecordingError& e) {
        return e.what();
    }
    return "no fault found";
}

/// A change that makes a valid recording invalid, and the required beginning and content of the
/// error message.
struct Fault {
    const char* name;
    std::function<void(const fs::path& root)> inflict;
    std::string where;
    std::string what;
};

std::function<void(const fs::path&)> edit(const char* file, const char* from, const char* to) {
    return [=](const fs::path& root) { replaceInFile(root / file, from, to); };
}

std::function<void(const fs::path&)> removal(const char* file) {
    return [=](const fs::path& root) { fs::remove_all(root / file); };
}

void cutTail(const fs::path& file) {
    fs::resize_file(file, fs::file_size(file) - 5);
}

constexpr const char* kVideoCsv = "cam0/data.csv";
constexpr const char* kStillCsv = "cam1/data.csv";
constexpr const char* kVideoYaml = "cam0/sensor.yaml";
constexpr const char* kStillYaml = "cam1/sensor.yaml";
constexpr const char* kPoses = "state_groundtruth_estimate0/data.csv";

const Fault kFaults[] = {
    {"NoVideoFolder", removal("cam0"), "cam0: ", "no such folder"},
    {"NoStillFolder", removal("cam1"), "cam1: ", "no such folder"},
    {"NoVideoList", removal(kVideoCsv), "cam0/data.csv: ", "is missing"},
    {"NoStillList", removal(kStillCsv), "cam1/data.csv: ", "is missing"},
    {"NoPoseList", removal(kPoses), "state_groundtruth_estimate0/data.csv: ", "is missing"},
    {"NoVideoCalibration", removal(kVideoYaml), "cam0/sensor.yaml: ", "is missing"},
    {"NoStillCalibration", removal(kStillYaml), "cam1/sensor.yaml: ", "is missing"},
    {"EmptyCalibration", [](const fs::path& r) { writeFile(r / kVideoYaml, ""); },
     "cam0/sensor.yaml:1: ", "is not a YAML map"},
    {"NoPictureInVideo", [](const fs::path& r) { writeFile(r / kVideoCsv, "#only a header\n"); },
     "cam0/data.csv: ", "lists no picture"},
    {"PictureMissing", removal("cam0/data/1500000000.png"), "cam0/data.csv:3: ", "is missing"},
    {"PictureOfWrongSize",
     [](const fs::path& r) {
         savePng(r / "cam1/data/1500000000.png", test::plain({33, 24}, 0).view());
     },
     "cam1/data.csv:2: ", "is 33x24, but sensor.yaml says 32x24"},
    {"PictureTruncated", [](const fs::path& r) { cutTail(r / "cam0/data/2000000000.png"); },
     "cam0/data.csv:4: ", "is a truncated PNG file"},
    {"PictureCutInHeader",
     [](const fs::path& r) { fs::resize_file(r / "cam0/data/2000000000.png", 20); },
     "cam0/data.csv:4: ", "is a truncated PNG file"},
    {"PictureEmpty", [](const fs::path& r) { writeFile(r / "cam0/data/2000000000.png", ""); },
     "cam0/data.csv:4: ", "is a truncated PNG file"},
    {"PictureNoPng",
     [](const fs::path& r) { writeFile(r / "cam0/data/2000000000.png", "JFIF, perhaps"); },
     "cam0/data.csv:4: ", "is not a PNG file"},
    {"PictureIsFolder",
     [](const fs::path& r) {
         fs::remove(r / "cam0/data/2000000000.png");
         fs::create_directory(r / "cam0/data/2000000000.png");
     },
     "cam0/data.csv:4: ", "is missing"},
    {"TimesUnsorted", edit(kVideoCsv, "1500000000,", "2500000000,"),
     "cam0/data.csv:4: ", "timestamps must increase"},
    {"TimesDuplicate", edit(kVideoCsv, "1500000000,", "1000000000,"),
     "cam0/data.csv:3: ", "occurs twice"},
    {"TimeMalformed", edit(kVideoCsv, "1500000000,", "15e8,"),
     "cam0/data.csv:3: ", "not a whole number"},
    {"TimeNegative", edit(kVideoCsv, "1000000000,", "-1,"), "cam0/data.csv:2: ", "out of range"},
    {"TimeTooLarge", edit(kVideoCsv, "2000000000,", "9000000000000000000,"),
     "cam0/data.csv:4: ", "out of range"},
    {"TimeBeyondInteger", edit(kVideoCsv, "2000000000,", "99999999999999999999,"),
     "cam0/data.csv:4: ", "not a whole number"},
    {"FileNameClimbsOut", edit(kVideoCsv, ",1500000000.png", ",../data/1500000000.png"),
     "cam0/data.csv:3: ", "must not contain a path"},
    {"FileNameIsParent", edit(kVideoCsv, ",1500000000.png", ",.."),
     "cam0/data.csv:3: ", "must not contain a path"},
    {"FileNameAbsolute", edit(kVideoCsv, ",1500000000.png", ",/etc/passwd"),
     "cam0/data.csv:3: ", "must not contain a path"},
    {"FileNameMissing", edit(kVideoCsv, ",1500000000.png", ""), "cam0/data.csv:3: ", "1 columns"},
    {"FileNameEmpty", edit(kVideoCsv, ",1500000000.png", ","),
     "cam0/data.csv:3: ", "must not contain a path"},
    {"PoseNaN", edit(kPoses, "2000000000,2", "2000000000,nan"),
     "state_groundtruth_estimate0/data.csv:3: ", "not a finite number"},
    {"PoseInfinite", edit(kPoses, "1000000000,1", "1000000000,-inf"),
     "state_groundtruth_estimate0/data.csv:2: ", "not a finite number"},
    {"PoseOverflow", edit(kPoses, "1000000000,1", "1000000000,1e999"),
     "state_groundtruth_estimate0/data.csv:2: ", "is not a number"},
    {"PoseMalformed", edit(kPoses, "1000000000,1", "1000000000,1x"),
     "state_groundtruth_estimate0/data.csv:2: ", "is not a number"},
    {"PoseShort", edit(kPoses, ",0,0,0\n", ",0,0\n"),
     "state_groundtruth_estimate0/data.csv:2: ", "7 columns"},
    {"QuaternionNotUnit", edit(kPoses, "0.70710678,0,0", "0.8,0,0"),
     "state_groundtruth_estimate0/data.csv:3: ", "the quaternion has length"},
    {"QuaternionZero", edit(kPoses, "1,0,0,0\n", "0,0,0,0\n"),
     "state_groundtruth_estimate0/data.csv:2: ", "the quaternion has length 0"},
    {"PoseTimesUnsorted", edit(kPoses, "2000000000,", "900000000,"),
     "state_groundtruth_estimate0/data.csv:3: ", "timestamps must increase"},
    {"YamlSyntax", edit(kVideoYaml, "[16, 12]", "[16, 12"), "cam0/sensor.yaml:1", ""},
    {"ResolutionMissing", edit(kVideoYaml, "resolution:", "other:"),
     "cam0/sensor.yaml: ", "has no key resolution"},
    {"ResolutionZero", edit(kVideoYaml, "[16, 12]", "[0, 12]"),
     "cam0/sensor.yaml:10: ", "resolution 0"},
    {"ResolutionHuge", edit(kVideoYaml, "[16, 12]", "[1000000, 12]"),
     "cam0/sensor.yaml:10: ", "is not a whole number from 1 to"},
    {"ResolutionFraction", edit(kVideoYaml, "[16, 12]", "[16.5, 12]"),
     "cam0/sensor.yaml:10: ", "is not a whole number from 1 to"},
    {"ResolutionOneNumber", edit(kVideoYaml, "[16, 12]", "[16]"),
     "cam0/sensor.yaml:10: ", "must be [width, height]"},
    {"IntrinsicsMissing", edit(kVideoYaml, "intrinsics:", "other:"),
     "cam0/sensor.yaml: ", "has no key intrinsics"},
    {"FocalLengthZero", edit(kVideoYaml, "20.5", "0"), "cam0/sensor.yaml:12: ", "focal length 0"},
    {"FocalLengthNegative", edit(kVideoYaml, "21.5", "-21.5"),
     "cam0/sensor.yaml:12: ", "focal length -21.5"},
    {"FocalLengthNaN", edit(kVideoYaml, "20.5", ".nan"), "cam0/sensor.yaml:12: ", "is not finite"},
    {"FocalLengthWord", edit(kStillYaml, "20.5", "long"),
     "cam1/sensor.yaml:12: ", "is not a number"},
    {"PrincipalPointFarOutside", edit(kVideoYaml, "7.5", "75"),
     "cam0/sensor.yaml:12: ", "lies far outside"},
    {"ThreeIntrinsics", edit(kVideoYaml, ", 5.5]", "]"),
     "cam0/sensor.yaml:12: ", "intrinsics must be"},
    {"ThreeDistortionCoefficients", edit(kVideoYaml, ", 0.002]", "]"),
     "cam0/sensor.yaml:14: ", "4 or 5"},
    {"DistortionInfinite", edit(kVideoYaml, "0.002]", ".inf]"),
     "cam0/sensor.yaml:14: ", "is not finite"},
    {"DistortionModelUnknown", edit(kVideoYaml, "radial-tangential", "equidistant"),
     "cam0/sensor.yaml:13: ", "'equidistant' is not supported"},
    {"CameraModelUnknown", edit(kVideoYaml, "pinhole", "omni"),
     "cam0/sensor.yaml:11: ", "'omni' is not supported"},
    {"TransformScaled", edit(kStillYaml, "[1.0, 0.0", "[1.1, 0.0"),
     "cam1/sensor.yaml:5: ", "is not a rotation"},
    {"TransformMirrored", edit(kStillYaml, "[1.0, 0.0", "[-1.0, 0.0"),
     "cam1/sensor.yaml:5: ", "is not a rotation"},
    {"TransformNaN", edit(kStillYaml, "0.014", ".nan"), "cam1/sensor.yaml:5: ", "is not finite"},
    {"SensorsInMillimetres", edit(kStillYaml, "0.014", "14"),
     "cam1/sensor.yaml: ", "the sensors are 14 m apart; expected 0 to 2 m"},
    {"TransformShort", edit(kStillYaml, "0.014,", ""), "cam1/sensor.yaml:5: ", "15 numbers"},
    {"TransformLastRow", edit(kStillYaml, "0.0, 1.0]", "0.0, 2.0]"),
     "cam1/sensor.yaml:5: ", "last row"},
    {"TransformMissing", edit(kStillYaml, "T_BS:", "T_XX:"),
     "cam1/sensor.yaml: ", "has no key T_BS"},
    {"VideoRateZero", edit(kVideoYaml, "rate_hz: 30", "rate_hz: 0"),
     "cam0/sensor.yaml: ", "rate_hz of the video must be above 0"},
    {"RateNegative", edit(kVideoYaml, "rate_hz: 30", "rate_hz: -30"),
     "cam0/sensor.yaml:9: ", "rate_hz of -30 Hz is not plausible"},
    {"RateTiny", edit(kVideoYaml, "rate_hz: 30", "rate_hz: 1e-300"),
     "cam0/sensor.yaml:9: ", "expected 0 or 0.01 to 10000 Hz"},
    {"FocalLengthTiny", edit(kVideoYaml, "20.5", "1e-300"),
     "cam0/sensor.yaml:12: ", "focal length 1e-300 px"},
    {"ListIsAPipe",
     [](const fs::path& root) {
         fs::remove(root / kVideoCsv);
         ASSERT_EQ(mkfifo((root / kVideoCsv).c_str(), 0600), 0);
     },
     "cam0/data.csv: ", "is missing"},
    {"ALineWithoutEnd",
     [](const fs::path& root) { writeFile(root / kVideoCsv, std::string(5000, ',')); },
     "cam0/data.csv: ", "has a line of more than 4096 characters"},
};

// One test covers all faults, because a process for each would take a minute in all.
TEST(Recording, EveryFaultIsRefusedWithTheFileAndTheLineIfKnown) {
    for (const Fault& fault : kFaults) {
        SCOPED_TRACE(fault.name);
        const TempFolder folder;
        test::writeSmallRecording(folder.path());
        ASSERT_EQ(faultOf(folder.path()), "no fault found");
        fault.inflict(folder.path());
        const std::string message = faultOf(folder.path());
        EXPECT_TRUE(message.starts_with((folder / fault.where).string())) << message;
        EXPECT_NE(message.find(fault.what), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(Recording, MissingFolderIsNamed) {
    EXPECT_EQ(faultOf("/nonexistent/recording"), "/nonexistent/recording: there is no such folder");
}

TEST(Recording, RecordingHasTheContentOfItsFiles) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    const Recording r = loadRecording(folder.path());
    ASSERT_EQ(r.video.size(), 3U);
    EXPECT_EQ(r.video[1].time.ns, 1'500'000'000);
    EXPECT_EQ(r.video[1].file, folder / "cam0/data/1500000000.png");
    ASSERT_EQ(r.stills.size(), 1U);
    EXPECT_EQ(r.videoRateHz, 30);
    EXPECT_EQ(r.rig.video.size, test::kSmallVideo);
    EXPECT_EQ(r.rig.still.size, test::kSmallStill);
    EXPECT_EQ(r.rig.video.fx, 20.5);
    EXPECT_EQ(r.rig.video.fy, 21.5);
    EXPECT_EQ(r.rig.video.cx, 7.5);
    EXPECT_EQ(r.rig.video.cy, 5.5);
    EXPECT_EQ(r.rig.video.distortion, (std::array<double, 5>{0.1, -0.02, 0.001, 0.002, 0}));
}

TEST(Recording, AStillSensorToTheRightShowsAPointFurtherLeft) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    const Recording r = loadRecording(folder.path());
    const Eigen::Vector3d p = r.rig.T_still_video * Eigen::Vector3d(0, 0, 1);
    EXPECT_TRUE(p.isApprox(Eigen::Vector3d(-0.014, 0, 1), 1e-12)) << p.transpose();
}

TEST(Recording, PosesDescribeTheVideoCameraNotTheBody) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    // A quarter turn about z and an offset give the video camera another frame than the body.
    replaceInFile(folder / kVideoYaml, "[1.0, 0.0, 0.0, 0,", "[0.0, -1.0, 0.0, 0.5,");
    replaceInFile(folder / kVideoYaml, "0.0, 1.0, 0.0, 0.0,", "1.0, 0.0, 0.0, 0.0,");
    const Recording r = loadRecording(folder.path());
    const RigidTransform T = r.poses.front().T_world_video;
    EXPECT_TRUE((T * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1.5, 3, 3), 1e-9));
    const Eigen::Vector3d q = r.rig.T_still_video * Eigen::Vector3d(1, 0, 0);
    EXPECT_TRUE(q.isApprox(Eigen::Vector3d(0.486, 1, 0), 1e-9)) << q.transpose();
}

TEST(Recording, PosesAreInterpolatedAndNotExtrapolated) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    writeFile(folder / kPoses, "1000000000,1,0,0,1,0,0,0\n1200000000,2,0,0,0,0,0,1\n");
    const Recording r = loadRecording(folder.path());
    EXPECT_FALSE(r.poseAt({999'999'999}).has_value());
    EXPECT_FALSE(r.poseAt({1'200'000'001}).has_value());
    ASSERT_TRUE(r.poseAt({1'200'000'000}).has_value());
    EXPECT_EQ(r.poseAt({1'200'000'000})->T_world_video.translation.x(), 2);
    const std::optional<Pose> middle = r.poseAt({1'100'000'000});
    ASSERT_TRUE(middle.has_value());
    EXPECT_EQ(middle->time.ns, 1'100'000'000);
    EXPECT_NEAR(middle->T_world_video.translation.x(), 1.5, 1e-12);
    EXPECT_NEAR(Eigen::AngleAxisd(middle->T_world_video.rotation).angle(), M_PI / 2, 1e-6);
}

TEST(Recording, NoPoseIsInterpolatedAcrossAGap) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    writeFile(folder / kPoses, "1000000000,1,0,0,1,0,0,0\n1250000000,2,0,0,1,0,0,0\n"
                               "1500000001,3,0,0,1,0,0,0\n");
    const Recording r = loadRecording(folder.path());
    EXPECT_TRUE(r.poseAt({1'100'000'000}).has_value());
    EXPECT_FALSE(r.poseAt({1'300'000'000}).has_value());
    EXPECT_TRUE(r.poseAt({1'500'000'001}).has_value());
}

TEST(Recording, WindowsLineEndsCommentsSpacesAndExtraPoseColumnsAreRead) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    writeFile(folder / kVideoCsv, "\xEF\xBB\xBF#timestamp [ns],filename\r\n\r\n"
                                  "1000000000, 1000000000.png\r\n# a remark\r\n"
                                  "1500000000,1500000000.png");
    writeFile(folder / kPoses, "1000000000,1,2,3,1,0,0,0,9,9,9\r\n");
    const Recording r = loadRecording(folder.path());
    EXPECT_EQ(r.video.size(), 2U);
    EXPECT_EQ(r.poses.size(), 1U);
}

TEST(Recording, ARecordingWithoutStillsAndPosesIsValid) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    writeFile(folder / kStillCsv, "#timestamp [ns],filename\n");
    fs::remove_all(folder / "state_groundtruth_estimate0");
    const Recording r = loadRecording(folder.path());
    EXPECT_TRUE(r.stills.empty());
    EXPECT_TRUE(r.poses.empty());
    EXPECT_FALSE(r.poseAt(r.video.front().time).has_value());
}

TEST(Recording, TheTimeOffsetOfTheStillsIsRelativeToThatOfTheVideo) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    replaceInFile(folder / kVideoYaml, "camera_model:", "time_offset: 0.25\ncamera_model:");
    EXPECT_EQ(loadRecording(folder.path()).stillTimeOffset, -0.25);
    replaceInFile(folder / kStillYaml, "camera_model:", "time_offset: 1.5\ncamera_model:");
    EXPECT_EQ(loadRecording(folder.path()).stillTimeOffset, 1.25);
    replaceInFile(folder / kStillYaml, "1.5", "-9.875");
    EXPECT_NE(
        faultOf(folder.path()).find("a time_offset difference between the cameras of -10.125 s"),
        std::string::npos);
}

TEST(Recording, TruthFilesAreFound) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    writeFile(folder / "truth/flow/1000000000_1500000000.flo", "x");
    const Recording r = loadRecording(folder.path());
    const Timestamp a = r.video[0].time, b = r.video[1].time;
    EXPECT_TRUE(r.truthFlow(a, b).has_value());
    EXPECT_FALSE(r.truthFlow(b, a).has_value());
    EXPECT_FALSE(r.truthHighRes(a).has_value());
    EXPECT_FALSE(r.truthInverseDepth(a).has_value());
}

TEST(Recording, ADamagedRecordingIsEitherReadOrRefusedWithARecordingError) {
    const TempFolder folder;
    test::writeSmallRecording(folder.path());
    std::mt19937 random(7);
    int refused = 0;
    for (int round = 0; round < 200; ++round) {
        const char* const files[] = {kVideoYaml, kStillYaml, kVideoCsv, kPoses};
        const fs::path file = folder / files[random() % 4];
        const std::string good = test::readFile(file);
        const std::string bad = test::damaged(good, random);
        writeFile(file, bad);
        SCOPED_TRACE(bad);
        refused += faultOf(folder.path()) != "no fault found" ? 1 : 0;
        writeFile(file, good);
    }
    EXPECT_GT(refused, 50);
    EXPECT_LT(refused, 200);
}

TEST(SharedRecordings, AllSharedRecordingsAndTheirPicturesAreRead) {
    const fs::path data = MFAR_SHARED_DATA;
    if (!fs::is_directory(data)) GTEST_SKIP() << "recordings of real scenes are missing: " << data;
    for (const char* name : {"fountain", "motorcycle", "books", "dolls", "teddy"}) {
        SCOPED_TRACE(name);
        const Recording r = loadRecording(data / name);
        EXPECT_FALSE(r.stills.empty());
        EXPECT_TRUE(r.poseAt(r.video.front().time).has_value());
        EXPECT_EQ(loadImage(r.video.front().file).size, r.rig.video.size);
        if (const auto truth = r.truthInverseDepth(r.video.front().time))
            EXPECT_EQ(loadPfm(*truth).size, r.rig.video.size);
        else
            EXPECT_TRUE(r.truthHighRes(r.video.front().time).has_value());
    }
}

}  // namespace
}  // namespace mfar
