#include "tests/measure/eval/scene_key.h"
#include "tests/measure/eval/warp_scenes.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mfar::eval {
namespace {

using test::execute;
using test::TempFolder;

constexpr const char* kSmall = "--scenes still-life --paths orbit --width 64 --height 48 "
                               "--budget 2 --frames 22 --every 10 --truth-samples 4";

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');)
        out.push_back(cell);
    return out;
}

TEST(MfarEvalTraced, ComparesFramesOfEachMethodAndKeepsTheTruth) {
    const TempFolder folder;
    const std::string root = folder.path().string();
    const auto outcome = execute(
        folder, fmt::format("'{0}' traced {1} --truth {2}/truth --save {2}/saved --video {2}/video "
                            "--hdrvdp --csv {2}/out.csv",
                            MFAR_EVAL, kSmall, root));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    std::istringstream in(test::readFile(folder / "out.csv"));
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, "recording,frame,method,psnr_db,shadow_psnr_db,flicker,pictures,first_s,"
                    "warp_ms,hdrvdp_q");
    int compared = 0;
    while (std::getline(in, line)) {
        const std::vector<std::string> row = cells(line);
        if (row[0] != "still-life/orbit" || row[1] != "20") continue;
        ++compared;
        // psnr_db: the grey background without objects would give 11 dB. The truth has only 4
        // samples per pixel, which limits PSNR to 35 dB.
        EXPECT_GT(std::stod(row[3]), 15) << line;
        EXPECT_LT(std::stod(row[3]), 60) << line;
        EXPECT_LT(std::stod(row[7]), 0.5) << line;
        EXPECT_GT(std::stod(row[9]), 20) << line;
        EXPECT_LT(std::stod(row[9]), 100) << line;
    }
    EXPECT_EQ(compared, 2) << "one row for each of two methods";
    // Frame 20 is compared; frames 0 and 10 are in the first half second. Flicker also needs the
    // truth of the frame after it.
    const auto files = std::filesystem::directory_iterator(folder / "truth");
    EXPECT_EQ(std::distance(begin(files), end(files)), 2);
    // Another version of the scene must not find these files.
    const std::string truth = fmt::format("truth/still-life-{:016x}-orbit-64x48-4-020.truth",
                                          sceneKey(*warpScene("still-life")));
    EXPECT_TRUE(std::filesystem::exists(folder / truth)) << truth;
    EXPECT_TRUE(std::filesystem::exists(folder / "saved/still-life-orbit-020-product.png"));
    // A frame of the video shows both methods side by side, in 4:2:0.
    constexpr std::uintmax_t kFrameBytes = 2 * 64 * 48 * 3 / 2;
    EXPECT_GT(std::filesystem::file_size(folder / "video/still-life-orbit.y4m"), 22 * kFrameBytes);
}

/// Writes a model with one triangle of the base colour (`red`, 0, 0).
void writeModel(const std::filesystem::path& file, double red) {
    test::GltfMaker maker = test::oneTriangle();
    maker.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0, 0, 1}}}}}};
    maker.root["meshes"][0]["primitives"][0]["material"] = 0;
    const std::vector<std::uint8_t> bytes = maker.glb();
    test::writeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::size_t filesIn(const std::filesystem::path& folder) {
    const auto files = std::filesystem::directory_iterator(folder);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(MfarEvalTraced, FilesOfTheSameNameHaveTheirOwnRowsPicturesAndTruth) {
    const TempFolder folder;
    writeModel(folder / "a/object.glb", 1);
    writeModel(folder / "b/object.glb", 0.5);
    const auto run = [&](const char* scenes) {
        return execute(folder, fmt::format("cd '{}' && '{}' traced --scenes {} --paths orbit "
                                           "--methods product --width 64 --height 48 --budget 2 "
                                           "--frames 16 --every 15 --truth-samples 1 --truth truth "
                                           "--save saved --csv out.csv",
                                           folder.path().string(), MFAR_EVAL, scenes));
    };
    auto outcome = run("a/object.glb,b/object.glb");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const std::string csv = test::readFile(folder / "out.csv");
    EXPECT_NE(csv.find("a/object.glb/orbit,mean"), std::string::npos) << csv;
    EXPECT_NE(csv.find("b/object.glb/orbit,mean"), std::string::npos) << csv;
    const std::size_t truths = filesIn(folder / "truth"), saved = filesIn(folder / "saved");
    EXPECT_EQ(saved, 2U * 1 * 2) << "two files, one compared frame, one method and its truth";
    outcome = run("b/object.glb");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(filesIn(folder / "truth"), truths) << "the second run reuses the stored truth";
    writeModel(folder / "b/object.glb", 0.25);
    outcome = run("b/object.glb");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(filesIn(folder / "truth"), truths + truths / 2) << "a changed file needs a new truth";
}

TEST(MfarEvalTraced, InvalidRequestsEndWithAMessageAndStatus2) {
    const TempFolder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"--scenes absent", "'absent' is neither"},
        {"--methods magic", "--methods"},
        {"--paths away", "--paths"},
        {"--budget nan", "--budget"},
        {"--frames 0", "--frames"},
        {"--every 0", "--every"},
        {"--width 100000", "--width"},
        {"--hdrvdp --width 64 --height 16", "--hdrvdp needs"},
        {"--frames 15", "no frame is scored"},
        {"--frames 30 --every 100", "--frames must be at least 101"},
    };
    for (const auto& [arguments, message] : cases) {
        const auto outcome = execute(folder, fmt::format("'{}' traced {}", MFAR_EVAL, arguments));
        EXPECT_EQ(outcome.status, 2) << arguments << outcome.text;
        EXPECT_NE(outcome.text.find(message), std::string::npos) << outcome.text;
    }
}

}  // namespace
}  // namespace mfar::eval
