#include "tests/measure/eval/tiny_recording.h"

#include <cmath>

namespace mfar::eval {
namespace {

using test::execute;
using test::Outcome;
using test::TempFolder;
namespace fs = std::filesystem;

TEST(MfarEval, SuperResWritesItsColumnsAndTheMean) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const Outcome outcome =
        execute(folder, fmt::format("{0} superres {1}/tiny --degrade gain=0.9,noise=1 --csv "
                                    "{1}/out.csv --save {1}/pictures",
                                    MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 2 * 7 + 7) << outcome.text;
    EXPECT_EQ(rows[0], split("recording,frame,method,ms,psnr_db,ssim,lpc_si,hdrvdp_q,harm_rate,"
                             "psnr_rgb_db,tiles_below,flicker"));
    for (std::size_t i = 1; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), rows[0].size());
        EXPECT_EQ(rows[i][0], "tiny");
        EXPECT_GT(std::stod(rows[i][3]), 0);
        EXPECT_GT(std::stod(rows[i][4]), 10);
        EXPECT_LE(std::stod(rows[i][5]), 1);
        EXPECT_TRUE(rows[i][6].empty() && rows[i][7].empty());
        EXPECT_LE(std::stod(rows[i][8]), 1);
    }
    EXPECT_EQ(rows[2][2], "detail2d");
    EXPECT_EQ(rows[4][2], "bilinear");
    EXPECT_EQ(rows[5][2], "bicubic");
    EXPECT_EQ(std::stod(rows[5][8]), 0);
    EXPECT_EQ(std::stod(rows[5][10]), 0);
    EXPECT_EQ(rows[6][2], "lanczos");
    EXPECT_EQ(rows.back()[1], "mean");
    EXPECT_TRUE(fs::exists(folder / "pictures/tiny/1000_detail.png"));
    EXPECT_TRUE(fs::exists(folder / "pictures/tiny/1001_truth.png"));
}

TEST(MfarEval, SuperResWithoutAStillComparesEnlargers) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const Outcome outcome = execute(
        folder, fmt::format("{0} superres {1}/tiny --no-still --methods detail,detail2d,bicubic "
                            "--csv {1}/out.csv",
                            MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 2 * 2 + 2) << "detail2d is left out, because it needs a still";
    EXPECT_EQ(rows[1][2], "detail");
    EXPECT_EQ(rows[2][2], "bicubic");
}

TEST(MfarEval, SuperResWithoutAStillMeasuresRecordingsWithoutStills) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    fs::remove_all(folder / "tiny/cam1/data");
    const std::string table = test::readFile(folder / "tiny/cam1/data.csv");
    test::writeFile(folder / "tiny/cam1/data.csv", table.substr(0, table.find('\n') + 1));
    const std::string command =
        fmt::format("{} superres {}/tiny --methods bicubic", MFAR_EVAL, folder.path().string());
    EXPECT_EQ(execute(folder, command).status, 2);
    const Outcome outcome = execute(folder, command + " --no-still");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("bicubic"), std::string::npos) << outcome.text;
}

TEST(MfarEval, SuperResDistinguishesClassesOfPixels) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const Outcome outcome = execute(
        folder, fmt::format("{0} superres {1}/tiny --classes --methods detail,bicubic --csv "
                            "{1}/out.csv",
                            MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("classes of pixels by mfar's flow"), 0U) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 2 * 2 + 2);
    ASSERT_EQ(rows[0].size(), 18U);
    EXPECT_EQ(rows[0][12], "outside_share");
    EXPECT_EQ(rows[0][17], "matched_gain_db");
    for (std::size_t i = 1; i < rows.size(); ++i) {
        double shares = 0;
        for (const std::size_t c : {12U, 14U, 16U})
            shares += std::stod(rows[i].at(c));
        EXPECT_NEAR(shares, 1, 1e-5);
        if (rows[i][2] != "bicubic") continue;
        for (const std::size_t c : {13U, 15U, 17U})
            EXPECT_TRUE(rows[i][c].empty() || std::abs(std::stod(rows[i][c])) < 1e-6);
    }
}

TEST(MfarEval, SuperResDegradesTheVideoForEveryMethod) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const auto psnrOf = [&](const std::string& options) {
        const Outcome outcome =
            execute(folder, fmt::format("{0} superres {1}/tiny --methods detail,bicubic {2} --csv "
                                        "{1}/out.csv",
                                        MFAR_EVAL, folder.path().string(), options));
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const auto rows = readCsv(folder / "out.csv");
        return std::array{std::stod(rows.at(1).at(4)), std::stod(rows.at(2).at(4)),
                          std::stod(rows.at(2).at(9))};
    };
    const auto clean = psnrOf(""), noisy = psnrOf("--degrade-video noise=20");
    EXPECT_LT(noisy[0], clean[0] - 1);
    EXPECT_LT(noisy[1], clean[1] - 1);
    EXPECT_LT(noisy[2], clean[2] - 1) << "psnr_rgb_db";
}

TEST(MfarEval, SuperResLearnsFromStillsBeforeItMeasures) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const std::string dir = folder.path().string();
    const auto learning = [&](const char* engine, const std::string& how) {
        return execute(folder, fmt::format("MFAR_ENGINE={} {} superres {}/tiny --no-still "
                                           "--methods detail --frames 1 {}",
                                           engine, MFAR_EVAL, dir, how));
    };
    const Outcome elsewhere = learning("simd", "--learn-from " + dir + "/tiny");
    ASSERT_EQ(elsewhere.status, 0) << elsewhere.text;
    EXPECT_NE(elsewhere.text.find("learned from"), std::string::npos) << elsewhere.text;
    // Returns the PSNR of the frame.
    const auto psnrOf = [&](const char* engine, const std::string& how) {
        const Outcome ran = learning(engine, how + "--csv " + dir + "/out.csv");
        EXPECT_EQ(ran.status, 0) << ran.text;
        EXPECT_EQ(ran.text.find("learned from") != std::string::npos, !how.empty()) << ran.text;
        const auto table = readCsv(folder / "out.csv");
        const auto column = std::ranges::find(table.at(0), "psnr_db") - table.at(0).begin();
        return std::stod(table.at(1).at(static_cast<std::size_t>(column)));
    };
    const double learned = psnrOf("simd", "--learn 2 ");
    EXPECT_GT(std::abs(learned - psnrOf("simd", "")), 0.01) << "learning has no effect";
    EXPECT_NEAR(psnrOf("gles", "--learn 2 "), learned, 0.1);
}

TEST(MfarEval, SuperResComputesSlowMetricsOnRequest) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const Outcome outcome =
        execute(folder, fmt::format("{0} superres {1}/tiny --methods bicubic --frames 1 --metrics "
                                    "psnr,msssim,lpc_si,lpc_si_tiles,hdrvdp --ppd 40 --csv "
                                    "{1}/out.csv",
                                    MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    EXPECT_EQ(rows.at(0), split("recording,frame,method,ms,psnr_db,ssim,lpc_si,hdrvdp_q,harm_rate,"
                                "msssim,lpc_si_p10,lpc_si_median,lpc_si_p90,lpc_ratio,hdrvdp_qmos,"
                                "hdrvdp_ppd,hdrvdp_peak,hdrvdp_black,hdrvdp_gamma,"
                                "psnr_rgb_db,tiles_below,flicker"));
    ASSERT_EQ(rows.at(1).size(), rows[0].size());
    EXPECT_TRUE(rows[1][5].empty());
    EXPECT_GT(std::stod(rows[1][6]), 0);
    EXPECT_LT(std::stod(rows[1][7]), 100);
    EXPECT_EQ(std::stod(rows[1][15]), 40);
}

}  // namespace
}  // namespace mfar::eval
