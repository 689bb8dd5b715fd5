#include "base/calibration/rig_files.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <charconv>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>

namespace mfar::test {
namespace {

namespace fs = std::filesystem;

void shiftStills(const fs::path& recording, long long ns) {
    std::istringstream in(readFile(recording / "cam1/data.csv"));
    std::string out;
    for (std::string line; std::getline(in, line);) {
        long long time = 0;
        const std::size_t comma = line.find(',');
        if (line[0] != '#' && comma != line.npos) {
            std::from_chars(line.data(), line.data() + comma, time);
            line = std::to_string(time + ns) + line.substr(comma);
        }
        out += line + "\n";
    }
    writeFile(recording / "cam1/data.csv", out);
}

void expectCamera(const CameraModel& found, const CameraModel& truth) {
    EXPECT_NEAR(found.fx, truth.fx, 1e-3 * truth.fx);
    EXPECT_NEAR(found.fy, truth.fy, 1e-3 * truth.fy);
    EXPECT_NEAR(found.cx, truth.cx, 0.5);
    EXPECT_NEAR(found.cy, truth.cy, 0.5);
}

TEST(MfarSim, InvalidArgumentsEndWithAMessageAndWriteNothing) {
    const TempFolder folder;
    const fs::path recording = folder / "recording";
    const std::string out = " --out " + recording.string();
    const std::pair<std::string, const char*> cases[] = {
        {"--seconds nan" + out, "--seconds"},
        {"--rate nan" + out, "--rate"},
        {"--stills nan" + out, "--stills"},
        {"--noise nan" + out, "--noise"},
        {"--seed -1" + out, "--seed"},
        {"--seed 18446744073709551616" + out, "--seed"},
        {"--seconds 0.1", "--out is required"},
        {"--rate 2 --stills 3" + out, "must not exceed --rate"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome ran = execute(folder, fmt::format("{} {}", MFAR_SIM, arguments));
        EXPECT_EQ(ran.status, 64) << arguments;
        EXPECT_EQ(ran.text.find("mfar-sim: "), 0U) << ran.text;
        EXPECT_NE(ran.text.find(message), std::string::npos) << ran.text;
        EXPECT_FALSE(fs::exists(recording)) << arguments;
    }
    EXPECT_EQ(execute(folder, std::string(MFAR_SIM) + " --list").status, 0);
    for (const char* option : {"--list", "--help"}) {
        const Outcome ran = execute(folder, fmt::format("({} {} >/dev/full)", MFAR_SIM, option));
        EXPECT_EQ(ran.status, 1) << option;
        EXPECT_NE(ran.text.find("cannot be written"), std::string::npos) << ran.text;
    }
}

TEST(MfarCalibrate, InvalidArgumentsAndAFullOutputEndWithAMessage) {
    const TempFolder folder;
    const std::string calibrate = MFAR_CALIBRATE;
    for (const char* arguments : {"", "recording", "recording --out out --max-offset 3", "--x"}) {
        const Outcome ran = execute(folder, fmt::format("{} {}", calibrate, arguments));
        EXPECT_EQ(ran.status, 64) << arguments;
        EXPECT_EQ(ran.text.find("mfar-calibrate: "), 0U) << ran.text;
    }
    EXPECT_EQ(execute(folder, calibrate + " --help").status, 0);
    const Outcome full = execute(folder, fmt::format("({} --help >/dev/full)", calibrate));
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.text.find("cannot be written"), std::string::npos) << full.text;
}

TEST(MfarCalibrate, RecoversTheRigFromARecording) {
    const TempFolder folder;
    const std::string recording = (folder / "recording").string(), out = (folder / "out").string();
    const Outcome made = execute(
        folder, fmt::format("{} --scene calibration --seconds 4 --rate 8 --stills 2 --no-truth "
                            "--out {}",
                            MFAR_SIM, recording));
    ASSERT_EQ(made.status, 0) << made.text;
    shiftStills(recording, 25'000'000);
    const std::string stills = recording + "/cam1/sensor.yaml";
    writeFile(stills, readFile(stills) + "time_offset: 0.1\n");
    const Outcome ran = execute(folder, fmt::format("{} {} --aprilgrid {}/aprilgrid.yaml --out {}",
                                                    MFAR_CALIBRATE, recording, recording, out));
    ASSERT_EQ(ran.status, 0) << ran.text;
    const RigCalibration truth = loadRig(recording), found = loadRig(out);
    expectCamera(found.rig.video, truth.rig.video);
    expectCamera(found.rig.still, truth.rig.still);
    const double baseline = truth.rig.T_still_video.translation.norm();
    EXPECT_NEAR(found.rig.T_still_video.translation.norm(), baseline, 0.01 * baseline);
    EXPECT_NEAR(found.stillTimeOffset, 0.1 - 0.025, 0.001)
        << "the offset with which the stills were recorded must be added";
    EXPECT_TRUE(fs::exists(fs::path(out) / "residuals.png"));
    for (const char* const words : {"% covered", "video views", "still views", "mm apart", "+-"})
        EXPECT_NE(ran.text.find(words), std::string::npos) << words << " in\n" << ran.text;
}

TEST(MfarCalibrate, ARecordingOfOneViewIsRefusedAndNothingIsWritten) {
    const TempFolder folder;
    const std::string recording = (folder / "recording").string(), out = (folder / "out").string();
    const Outcome made = execute(folder, fmt::format("{} --scene calibration --path rest --seconds "
                                                     "0.2 --stills 5 --no-truth --out {}",
                                                     MFAR_SIM, recording));
    ASSERT_EQ(made.status, 0) << made.text;
    const auto calibrate = [&](const std::string& target) {
        return execute(folder,
                       fmt::format("{} {} {} --out {}", MFAR_CALIBRATE, recording, target, out));
    };
    const Outcome ran = calibrate("--aprilgrid " + recording + "/aprilgrid.yaml");
    EXPECT_EQ(ran.status, 1);
    EXPECT_NE(ran.text.find("mfar-calibrate: too few views"), std::string::npos) << ran.text;
    EXPECT_FALSE(fs::exists(out));
    const Outcome unwritable =
        execute(folder, fmt::format("{} {} --aprilgrid {}/aprilgrid.yaml --out {}/tags.toml/out",
                                    MFAR_CALIBRATE, recording, recording, recording));
    EXPECT_EQ(unwritable.status, 1);
    EXPECT_NE(unwritable.text.find("/tags.toml/out: cannot be created: Not a directory"),
              std::string::npos)
        << unwritable.text;
    EXPECT_EQ(unwritable.text.find("searched"), std::string::npos) << unwritable.text;
    EXPECT_NE(calibrate("").text.find("a target is needed"), std::string::npos);
    EXPECT_NE(calibrate("--checkerboard 8x6 --square 0.02").text.find("upside down"),
              std::string::npos);
    EXPECT_NE(calibrate("--aprilgrid none.yaml").text.find("none.yaml: is missing"),
              std::string::npos);
}

}  // namespace
}  // namespace mfar::test
