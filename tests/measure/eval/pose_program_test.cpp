#include "hal/virtual/image_files.h"
#include "hal/virtual/recorder.h"
#include "tests/track/tag_scene.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace mfar::eval {
namespace {

namespace fs = std::filesystem;
using namespace test;

Outcome evaluate(const TempFolder& folder, const std::string& arguments) {
    return execute(folder, fmt::format("'{}' pose {}", MFAR_EVAL, arguments));
}

using CsvRow = std::map<std::string, std::string>;

std::vector<CsvRow> readCsv(const fs::path& file) {
    const auto split = [](const std::string& line) {
        std::vector<std::string> out;
        std::istringstream in(line + ",");
        for (std::string field; std::getline(in, field, ',');)
            out.push_back(field);
        return out;
    };
    std::istringstream in(readFile(file));
    std::string line;
    std::getline(in, line);
    const auto names = split(line);
    std::vector<CsvRow> out;
    while (std::getline(in, line)) {
        const auto fields = split(line);
        EXPECT_EQ(fields.size(), names.size());
        CsvRow& row = out.emplace_back();
        for (std::size_t i = 0; i < names.size(); ++i)
            row[names[i]] = fields.at(i);
    }
    return out;
}

const PlacedTag kTag{{TagFamily::Tag36h11, 12}, 0.1, {}};
constexpr const char* kTags = "family = \"tag36h11\"\n[[tags]]\nid = 12\nsize = 0.1\n"
                              "position = [0, 0, 0]\norientation = [1, 0, 0, 0]\n";

RigidTransform view(int i) {
    return cameraAt(0.5, 0.4 + 0.004 * i, -0.3, 0.1);
}

void writeRecording(const fs::path& root) {
    const StereoRig rig{testCamera().scaledTo({320, 240}), testCamera(), {}};
    Recorder recorder(root, rig, 30);
    for (int i = 0; i < 4; ++i) {
        Pose pose;
        pose.time = {1000 + 33'000'000LL * i};
        pose.T_world_video = view(i);
        ASSERT_TRUE(recorder.video(renderTags(rig.video, view(i), {kTag}).view(), pose.time));
        ASSERT_TRUE(recorder.pose(pose));
        if (i == 2) {
            ASSERT_TRUE(recorder.still(renderTags(rig.still, view(i), {kTag}).view(), pose.time));
        }
    }
    recorder.finish();
    writeFile(root / "tags.toml", kTags);
}

TEST(MfarEvalPose, MeasuresPosesOfARecording) {
    const TempFolder folder;
    writeRecording(folder / "tiny");
    const Outcome outcome =
        evaluate(folder, fmt::format("{0}/tiny --csv {0}/out.csv", folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 4U + 4 + 1 + 3 + 3) << outcome.text;
    for (const CsvRow& row : rows) {
        EXPECT_EQ(row.at("recording"), "tiny");
        EXPECT_LT(std::stod(row.at("rot_deg")), 1.5) << outcome.text;
        EXPECT_LT(std::stod(row.at("trans_mm")), 15);
        EXPECT_LT(std::stod(row.at("trans_percent")), 3);
        EXPECT_GT(std::stod(row.at("ms")), 0);
        EXPECT_EQ(std::stod(row.at("missed")), 0);
        EXPECT_EQ(row.at("flips").empty(), row.at("frame") != "median");
        if (row.at("frame") == "median") {
            EXPECT_EQ(std::stod(row.at("flips")), 0);
        }
    }
    EXPECT_EQ(rows.back().at("frame"), "median");
}

TEST(MfarEvalPose, CountsTagsInPictures) {
    const TempFolder folder;
    const CameraModel camera = testCamera();
    fs::create_directories(folder / "tags");
    savePng(folder / "tags" / "a.png", renderTags(camera, view(0), {kTag}).view());
    std::string line = "12";
    for (const Eigen::Vector2d& c : cornersOf(camera, view(0), kTag))
        line += fmt::format(", ({:.4f} {:.4f})", c.x() + 0.5, c.y() + 0.5);
    writeFile(folder / "tags" / "a.txt", line + "\n13, (9 9), (19 9), (19 19), (9 19)\n");
    const std::string arguments = fmt::format("{0}/tags --csv {0}/out.csv", folder.path().string());
    const Outcome outcome = evaluate(folder, arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 2U + 2) << outcome.text;
    for (const CsvRow& row : rows) {
        EXPECT_LT(std::stod(row.at("corner_px")), row.at("method") == "refined" ? 0.1 : 0.5);
        EXPECT_EQ(std::stod(row.at("found")), 1);
        EXPECT_EQ(std::stod(row.at("missed")), 1);
        EXPECT_EQ(std::stod(row.at("false")), 0);
    }
    writeFile(folder / "tags" / "a.txt", line + "\n13, (9 9), (19 9), (19 19), (9 nan)\n");
    const Outcome broken = evaluate(folder, arguments);
    EXPECT_EQ(broken.status, 2);
    EXPECT_NE(broken.text.find("a.txt:2: the line is not \"id, (x y)"), std::string::npos)
        << broken.text;
}

TEST(MfarEvalPose, InvalidRequestsEndWithAMessageAndStatus2) {
    const TempFolder folder;
    writeRecording(folder / "bare");
    fs::remove(folder / "bare" / "tags.toml");
    writeRecording(folder / "broken");
    replaceInFile(folder / "broken" / "tags.toml", "size = 0.1", "size = -1");
    fs::create_directories(folder / "empty");
    const std::pair<std::string, std::string> cases[] = {
        {"absent", "absent"},
        {"bare", "tags.toml: is missing"},
        {"broken", "tags.toml:4: size must be from 0.001 to 100 m"},
        {"empty", "neither a recording nor"},
        {"bare --methods wonder", "unknown method 'wonder' (valid: filtered, raw, still)"},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome outcome = evaluate(folder, folder.path().string() + '/' + arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_NE(outcome.text.find(message), std::string::npos) << outcome.text;
    }
}

}  // namespace
}  // namespace mfar::eval
