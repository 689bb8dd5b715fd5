#include "tests/unit/run_program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
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
    EXPECT_EQ(line,
              "recording,frame,method,psnr_db,shadow_psnr_db,flicker,pictures,warp_ms,hdrvdp_q");
    int compared = 0;
    while (std::getline(in, line)) {
        const std::vector<std::string> row = cells(line);
        if (row[0] != "still-life/orbit" || row[1] != "20") continue;
        ++compared;
        // Grey paper alone would give 11 dB. The truth has only 4 samples per pixel, which limits
        // PSNR to 35 dB.
        EXPECT_GT(std::stod(row[3]), 15) << line;
        EXPECT_LT(std::stod(row[3]), 60) << line;
        EXPECT_GT(std::stod(row[8]), 20) << line;
        EXPECT_LT(std::stod(row[8]), 100) << line;
    }
    EXPECT_EQ(compared, 2) << "one row for each of two methods";
    // Frames 0, 1, 10, 11, 20 and 21 are compared.
    const auto files = std::filesystem::directory_iterator(folder / "truth");
    EXPECT_EQ(std::distance(begin(files), end(files)), 6);
    EXPECT_TRUE(std::filesystem::exists(folder / "saved/still-life-orbit-020-product.png"));
    // A frame shows both methods side by side, in 4:2:0.
    constexpr std::uintmax_t kFrameBytes = 2 * 64 * 48 * 3 / 2;
    EXPECT_GT(std::filesystem::file_size(folder / "video/still-life-orbit.y4m"), 22 * kFrameBytes);
}

TEST(MfarEvalTraced, InvalidRequestsEndWithStatus2) {
    const TempFolder folder;
    for (const char* arguments :
         {"--scenes absent", "--methods magic", "--paths away", "--budget nan", "--frames 0",
          "--every 0", "--width 100000", "--hdrvdp --width 64 --height 16"}) {
        const auto outcome =
            execute(folder, fmt::format("'{}' traced --frames 1 {}", MFAR_EVAL, arguments));
        EXPECT_EQ(outcome.status, 2) << arguments << outcome.text;
    }
}

}  // namespace
}  // namespace mfar::eval
