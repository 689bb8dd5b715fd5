#include "base/calibration/plausible_ranges.h"
#include "base/calibration/rig_files.h"
#include "base/calibration/sensor_yaml.h"
#include "tests/calibration/rig_texts.h"
#include "tests/unit/damage.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <random>
#include <string>

namespace mfar::test {
namespace {

namespace fs = std::filesystem;

const WantedSizes kSizes{Size{640, 480}, Size{2304, 1728}};

std::string faultOf(const fs::path& path) {
    try {
        static_cast<void>(loadRig(path, kSizes));
    } catch (const CalibrationError& e) {
        return e.what();
    }
    return "no fault found";
}

void writeAll(const fs::path& root) {
    saveRig(root / "own", sampleRig());
    writeFile(root / "camchain.yaml", kKalibrText);
    writeFile(root / "cv.yml", openCvText());
}

/// A fault: in `file`, the text `from` is replaced by `to`. Loading the folder or file `load` must
/// then give a message that starts with `where` and contains `what`. If `what` is "no fault found",
/// the text is valid also after the replacement, and loading must succeed.
struct Fault {
    const char *load, *file, *from, *to, *where, *what;
};

constexpr const char* kRig = "own/rig.yaml";
constexpr const char* kVideo = "own/video.yaml";
constexpr const char* kStill = "own/still.yaml";
constexpr const char* kChain = "camchain.yaml";
constexpr const char* kCv = "cv.yml";

constexpr Fault kFaults[] = {
    {"own", kRig, "-0.6", ".nan", "own/rig.yaml:6: ", "not finite"},
    {"own", kRig, "0.8", "0.9", "own/rig.yaml:6: ", "not a rotation"},
    {"own", kRig, "-0.014", "-14", "own/rig.yaml:6: ", "metres"},
    {"own", kRig, "0.0, 1.0]", "0.0, 2.0]", "own/rig.yaml:6: ", "last row"},
    {"own", kRig, "  - [0.0, 0.0, 0.0, 1.0]\n", "", "own/rig.yaml:6: ", "12 numbers; expected 16"},
    {"own", kRig, "0.0025", "1e9", "own/rig.yaml:11: ", "is not plausible"},
    {"own", kRig, "0.0025", "soon", "own/rig.yaml:11: ", "is not a number"},
    {"own", kRig, "video.yaml", "../video.yaml", "own/rig.yaml:2: ", "without a path"},
    {"own", kRig, "video.yaml", "none.yaml", "own/none.yaml: ", "is missing"},
    {"own", kRig, "video: ", "other: ", "own/rig.yaml: ", "has no key video"},
    {"own", kRig,
     "T_still_video:", "T:", "own/rig.yaml: ", "is not a calibration in a known format"},
    {"own", kVideo, "560.4", "0", "own/video.yaml:7: ", "is singular"},
    {"own", kVideo, "560.4", "-560.4", "own/video.yaml:7: ", "focal length -560.4 px"},
    {"own", kVideo, "560.4", "1e-300", "own/video.yaml:7: ", "singular"},
    {"own", kVideo, "560.4", "1.5", "own/video.yaml:7: ", "0.05 to 100 picture widths"},
    {"own", kVideo, "-0.115", "900", "own/video.yaml:12: ", "distance of a picture corner"},
    {"own", kVideo, "-0.115", "-1e4",
     "own/video.yaml:12: ", "not plausible; expected -1000 to 1000"},
    {"own", kVideo, "0.0006", "900", "own/video.yaml:12: ", ""},
    {kChain, kChain, "560.4", "1e-300", "camchain.yaml:5: ", "focal length 1e-300 px"},
    {"own", kVideo, "560.4", "64001", "own/video.yaml:7: ", "focal length 64001 px"},
    {"own", kVideo, "321.7", "9000", "own/video.yaml:7: ", "far outside"},
    {"own", kVideo, "560.4, 0", "560.4, 3", "own/video.yaml:7: ", "skew"},
    {"own", kVideo, "237.6, 0, 0, 1]", "237.6, 0, 0, 2]",
     "own/video.yaml:7: ", "the form [fx 0 cx"},
    {"own", kVideo, "plumb_bob", "equidistant",
     "own/video.yaml:8: ", "'equidistant' is not supported"},
    {"own", kVideo, "-0.115", ".inf", "own/video.yaml:12: ", "not finite"},
    {"own", kVideo, "-0.115", "-4", "own/video.yaml:12: ", "several rays"},
    {"own", kVideo, "-0.115, 0.062", "-0.3, 0.0", "own/video.yaml:12: ", "several rays"},
    {"own", kVideo, "-0.0005, 0]", "-0.0005, 0, 0.1]", "own/video.yaml:12: ", "coefficient 6"},
    {"own", kVideo, "-0.115, 0.062, ", "", "own/video.yaml:12: ", "3 distortion coefficients"},
    {"own", kStill, "2304", "2304.5", "own/still.yaml:1: ", "not a whole number"},
    {"own", kStill, "1728", "-1728", "own/still.yaml:1: ", "not a whole number"},
    {"own", kStill, "camera_matrix", "matrix", "own/still.yaml: ", "has no key camera_matrix"},
    {"own", kStill, "image_width: ", "image_width 12", "own/still.yaml", ""},
    {kVideo, kVideo, "video", "video", "own/video.yaml: ", "describes only one camera"},
    {kChain, kChain, "radtan", "equidistant",
     "camchain.yaml:4: ", "'equidistant' is not supported"},
    {kChain, kChain, "pinhole", "omni", "camchain.yaml:2: ", "'omni' is not supported"},
    {kChain, kChain, "pinhole", "eucm", "camchain.yaml:2: ", "'eucm' is not supported"},
    {kChain, kChain, "cam1", "cam2", "camchain.yaml: ", "has no key cam1"},
    {kChain, kChain, "T_cn_cnm1", "T_other", "camchain.yaml:10: ", "has no key T_cn_cnm1"},
    {kChain, kChain, "0.8, -0.6", "0.8, 0.6", "camchain.yaml:11: ", "not a rotation"},
    {kChain, kChain, "[0.8, -0.6, 0.0,", "[0.8, -0.6,", "camchain.yaml:11: ", "row of 3 numbers"},
    {kChain, kChain, "timeshift_cam_imu: 0.001\n", "timeshift_cam_imu: -10\n",
     "camchain.yaml:21: ", "a timeshift_cam_imu difference between the cameras of 10.0035 s"},
    {kChain, kChain, "1962.0", "nan", "camchain.yaml:18: ", "is not a number"},
    {kChain, kChain, "[2304, 1728]", "[2304]", "camchain.yaml:19: ", "must be [width, height]"},
    {kChain, kChain, "cam0:", "cam0: 5\ncam5:", "camchain.yaml:1: ", "has no key camera_model"},
    {kCv, kCv, "560.4, 0.", "0., 0.", "cv.yml:7: ", "is singular"},
    {kCv, kCv, "1962.", "-1962.", "cv.yml:17: ", "focal length -1962 px"},
    {kCv, kCv, "8.0e-01", "9.0e-01", "cv.yml:27: ", "R is not a rotation"},
    {kCv, kCv, "-0.014", "-14.0", "cv.yml:32: ", "metres"},
    {kCv, kCv, "0.0006,", "", "cv.yml:12: ", "no fault found"},
    {kCv, kCv, "data: [ -0.014", "values: [ -0.014", "cv.yml:28: ", "T has no key \"data\""},
    {kCv, kCv, "D2", "E2", "cv.yml: ", "has no key D2"},
    {kCv, kCv, "%YAML:1.0", "<?xml?>", "cv.yml:1: ", "is XML"},
    {"nowhere.yaml", kCv, "M1", "M1", "nowhere.yaml: ", "is missing"},
    {".", kCv, "M1", "M1", ".: ", "contains neither rig.yaml nor"},
};

TEST(RigFiles, EveryFaultIsRefusedWithTheFileAndTheLineIfKnown) {
    const TempFolder sound;
    writeAll(sound.path());
    for (const char* const load : {"own", kChain, kCv})
        ASSERT_EQ(faultOf(sound / load), "no fault found");
    for (const Fault& fault : kFaults) {
        const TempFolder folder;
        writeAll(folder.path());
        replaceInFile(folder / fault.file, fault.from, fault.to);
        SCOPED_TRACE(std::string(fault.file) + ": " + fault.from + " -> " + fault.to);
        const std::string message = faultOf(folder / fault.load);
        if (std::string(fault.what) == "no fault found") {
            EXPECT_EQ(message, fault.what);
            continue;
        }
        EXPECT_TRUE(message.starts_with((folder / fault.where).string())) << message;
        EXPECT_NE(message.find(fault.what), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST(RigFiles, DeeplyNestedOrVeryLongFilesAreRefusedBeforeParsing) {
    const TempFolder folder;
    std::string many = "a: [0";
    for (int i = 0; i < 150'000; ++i)
        many += ",0";
    const std::pair<std::string, const char*> texts[] = {
        {"a: " + std::string(100'000, '['), "nested more than 16 levels deep"},
        {"a: " + std::string(100'000, '{'), "nested more than 16 levels deep"},
        {many + "]", "more than 50000 values"},
        {"a: &x [1, 2]\nb: [*x, *x]\n", "aliases are not supported"},
    };
    for (const auto& [text, what] : texts) {
        writeFile(folder / "rig.yaml", text);
        EXPECT_NE(faultOf(folder / "rig.yaml").find(what), std::string::npos)
            << faultOf(folder / "rig.yaml");
    }
}

// The file name is too long for the file system. A file without read permission would not do,
// because root may read it.
TEST(RigFiles, APathThatCannotBeLookedUpIsRefused) {
    const std::string name(300, 'a');
    EXPECT_NE(faultOf(name).find(name), std::string::npos);
    EXPECT_NE(faultOf(name), "no fault found");
}

// The folder exists, but the paths of its files are too long.
TEST(RigFiles, AFolderWhoseFilesCannotBeLookedUpIsRefusedWithTheReason) {
    const TempFolder folder;
    std::string path = folder.path().string();
    while (path.size() < 4090)
        path += "/.";
    ASSERT_TRUE(fs::is_directory(path));
    EXPECT_EQ(faultOf(path), path + "/rig.yaml: File name too long");
}

TEST(RigFiles, DevicesAndPipesAreRefused) {
    const TempFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const fs::path& file : {folder / "pipe", fs::path("/dev/zero")})
        EXPECT_EQ(faultOf(file), file.string() + ": is not a regular file");
}

TEST(RigFiles, TheDocumentationListsTheAcceptedRanges) {
    const std::string page = readFile(MFAR_CALIBRATION_PAGE);
    for (const plausible::Range& range : plausible::kRanges)
        EXPECT_NE(page.find(fmt::format("| {} | {} | {} | {} |\n", range.what, range.unit,
                                        range.least, range.most)),
                  std::string::npos)
            << range.what;
}

TEST(RigFiles, AnImplausibleDifferenceOfTheTimeOffsetsOfTwoSensorFilesIsRefused) {
    const TempFolder folder;
    const StereoRig rig = sampleRig().rig;
    const fs::path video = folder / "cam0/sensor.yaml", still = folder / "cam1/sensor.yaml";
    writeFile(video, sensorYamlText({rig.video, {}, 30, 6}, "video"));
    writeFile(still, sensorYamlText({rig.still, rig.T_still_video.inverse(), 0, -6}, "still"));
    const std::string message = faultOf(folder.path());
    EXPECT_TRUE(message.starts_with(still.string() + ":")) << message;
    EXPECT_NE(message.find("a time_offset difference between the cameras of -12 s"),
              std::string::npos)
        << message;
}

TEST(RigFiles, ImplausibleLensOfAnOpenCvFileWithoutSizeIsRefused) {
    const TempFolder folder;
    std::string text = openCvText();
    writeFile(folder / "cv.yml", text.substr(0, text.find("image_size1")));
    EXPECT_EQ(faultOf(folder / "cv.yml"), "no fault found");
    EXPECT_THROW((void)loadRig(folder / "cv.yml"), CalibrationError);
    EXPECT_THROW((void)loadRig(folder / "cv.yml", {Size{1280, 960}, Size{2304, 1728}}),
                 CalibrationError);
}

TEST(RigFiles, ADamagedFileIsReadOrGivesACalibrationError) {
    const TempFolder folder;
    writeAll(folder.path());
    std::mt19937 random(11);
    int refused = 0;
    constexpr int kRounds = 300;
    for (int round = 0; round < kRounds; ++round) {
        const char* const files[] = {kRig, kVideo, kStill, kChain, kCv};
        const char* const loads[] = {"own", "own", "own", kChain, kCv};
        const auto which = random() % 5;
        const fs::path file = folder / files[which];
        const std::string good = readFile(file);
        const std::string bad = damaged(good, random);
        writeFile(file, bad);
        SCOPED_TRACE(bad);
        refused += faultOf(folder / loads[which]) != "no fault found" ? 1 : 0;
        writeFile(file, good);
    }
    EXPECT_GT(refused, kRounds / 4);
    EXPECT_LT(refused, kRounds);
}

}  // namespace
}  // namespace mfar::test
