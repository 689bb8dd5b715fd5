#include "base/calibration/rig_files.h"
#include "base/calibration/sensor_yaml.h"
#include "tests/calibration/rig_texts.h"
#include "tests/unit/same_camera.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>

namespace mfar::test {
namespace {

namespace fs = std::filesystem;

void expectSameRig(const RigCalibration& a, const RigCalibration& b, double offset) {
    expectSame(a.rig.video, b.rig.video);
    expectSame(a.rig.still, b.rig.still);
    EXPECT_LT(a.rig.T_still_video.rotation.angularDistance(b.rig.T_still_video.rotation), 1e-12);
    EXPECT_LT((a.rig.T_still_video.translation - b.rig.T_still_video.translation).norm(), 1e-15);
    EXPECT_NEAR(a.stillTimeOffset, offset, 1e-15);
}

TEST(RigFiles, SavedFilesAreReadBack) {
    const TempFolder folder;
    RigCalibration rig = sampleRig();
    rig.rig.video.fx = 560.1234567890123;
    rig.rig.still.distortion[4] = 1. / 3;
    saveRig(folder / "made", rig);
    expectSameRig(loadRig(folder / "made"), rig, 0.0025);
    expectSameRig(loadRig(folder / "made/rig.yaml", {Size{640, 480}, Size{2304, 1728}}), rig,
                  0.0025);
}

TEST(RigFiles, KalibrsCamchainIsRead) {
    const TempFolder folder;
    writeFile(folder / "camchain.yaml", kKalibrText);
    expectSameRig(loadRig(folder / "camchain.yaml"), sampleRig(), 0.0025);
}

TEST(RigFiles, KalibrsPosesRelativeToTheInertialSensorAreRead) {
    const TempFolder folder;
    const fs::path file = folder / "camchain.yaml";
    writeFile(file, kKalibrText);
    replaceInFile(file, "T_cn_cnm1", "T_cam_imu");
    // The video camera is 0.1 m behind the inertial sensor: T_still_video = T_still_imu *
    // T_imu_video.
    replaceInFile(file, "  camera_model",
                  "  T_cam_imu: [[1, 0, 0, 0], [0, 1, 0, 0], "
                  "[0, 0, 1, 0.1], [0, 0, 0, 1]]\n  camera_model");
    const RigidTransform T = loadRig(file).rig.T_still_video;
    EXPECT_TRUE(T.translation.isApprox(Eigen::Vector3d(-0.014, 0.001, -0.0995), 1e-12));
}

TEST(RigFiles, OpenCvStorageIsReadFromOneFileOrTwo) {
    const TempFolder folder;
    writeFile(folder / "all.yml", openCvText());
    expectSameRig(loadRig(folder / "all.yml"), sampleRig(), 0);
    const std::array<fs::path, 2> pair{folder / "intrinsics.yml", folder / "extrinsics.yml"};
    writeFile(pair[0], kOpenCvIntrinsics);
    writeFile(pair[1], kOpenCvExtrinsics);
    const WantedSizes sizes{Size{640, 480}, Size{2304, 1728}};
    expectSameRig(loadRig(pair, sizes), sampleRig(), 0);
    const std::array<fs::path, 2> turned{pair[1], pair[0]};
    expectSameRig(loadRig(turned, sizes), sampleRig(), 0);
}

TEST(RigFiles, OpenCvsLongNamesAndOldHeaderAreRead) {
    const TempFolder folder;
    std::string text = openCvText();
    const std::array<std::array<const char*, 2>, 5> names{{{"M1", "cameraMatrix1"},
                                                           {"D1", "distCoeffs1"},
                                                           {"M2", "cameraMatrix2"},
                                                           {"D2", "distCoeffs2"},
                                                           {"\n---", ""}}};
    for (const auto& [from, to] : names)
        text.replace(text.find(from), std::string(from).size(), to);
    writeFile(folder / "all.yml", text);
    expectSameRig(loadRig(folder / "all.yml"), sampleRig(), 0);
}

TEST(RigFiles, IfAFileCannotBeWrittenTheOldCalibrationStaysWhole) {
    const TempFolder folder;
    saveRig(folder.path(), sampleRig());
    RigCalibration other = sampleRig();
    other.rig.video.fx *= 1.1;
    // A folder has the name of the temporary file of still.yaml.
    const std::string part = fmt::format("still.yaml.{}.part", gettid());
    fs::create_directory(folder / part);
    EXPECT_THROW(saveRig(folder.path(), other), std::runtime_error);
    fs::remove(folder / part);
    expectSameRig(loadRig(folder.path()), sampleRig(), 0.0025);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 3)
        << "no temporary file may be left";
}

TEST(RigFiles, EurocFilesAreReadAsAPairOrFromTheirRecording) {
    const TempFolder folder;
    const RigCalibration rig = sampleRig();
    const fs::path video = folder / "cam0/sensor.yaml", still = folder / "cam1/sensor.yaml";
    const RigidTransform body{Eigen::Quaterniond::UnitRandom(), {1, 2, 3}};
    writeFile(video, sensorYamlText({rig.rig.video, body, 30, 0.01}, "video"));
    writeFile(
        still,
        sensorYamlText({rig.rig.still, body * rig.rig.T_still_video.inverse(), 0, -0.03}, "still"));
    for (const RigCalibration& read :
         {loadRig(folder.path()), loadRig(std::array<fs::path, 2>{video, still})}) {
        const RigidTransform& T = read.rig.T_still_video;
        EXPECT_LT(T.rotation.angularDistance(rig.rig.T_still_video.rotation), 1e-9);
        EXPECT_LT((T.translation - rig.rig.T_still_video.translation).norm(), 1e-9);
        expectSame(read.rig.video, rig.rig.video);
        expectSame(read.rig.still, rig.rig.still);
        EXPECT_NEAR(read.stillTimeOffset, -0.03 - 0.01, 1e-15);
    }
}

TEST(RigFiles, ACalibrationOfAnotherSizeIsRefusedInEveryFormat) {
    const TempFolder folder;
    saveRig(folder / "own", sampleRig());
    writeFile(folder / "camchain.yaml", kKalibrText);
    writeFile(folder / "all.yml", openCvText());
    const std::array<std::array<const char*, 3>, 3> where{
        {{"own", "own/video.yaml:1: ", "own/still.yaml:1: "},
         {"camchain.yaml", "camchain.yaml:6: ", "camchain.yaml:19: "},
         {"all.yml", "all.yml:33: ", "all.yml:34: "}}};
    const auto fault = [&](const char* file, const WantedSizes& wanted) -> std::string {
        try {
            static_cast<void>(loadRig(folder / file, wanted));
        } catch (const CalibrationError& e) {
            return e.what();
        }
        return "no fault found";
    };
    for (const auto& [file, video, still] : where) {
        const std::string ofVideo = fault(file, {Size{1280, 960}, {}});
        EXPECT_EQ(ofVideo,
                  (folder / video).string() +
                      "is a calibration for 640x480 pixels, but the sensor delivers 1280x960");
        const std::string ofStill = fault(file, {{}, Size{640, 480}});
        EXPECT_EQ(ofStill,
                  (folder / still).string() +
                      "is a calibration for 2304x1728 pixels, but the sensor delivers 640x480");
    }
}

}  // namespace
}  // namespace mfar::test
