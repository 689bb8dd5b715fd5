#include "hal/virtual/image_files.h"
#include "hal/virtual/recorder.h"
#include "tests/bench/workload.h"
#include "tests/eval/picture.h"
#include "tests/unit/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

/// The programs as a user runs them, on tiny pictures: they must not rot. How good and how fast the
/// product is, is not asserted here.
namespace mfar::eval {
namespace {

using test::TempFolder;
namespace fs = std::filesystem;

struct Outcome {
    int status = -1;
    std::string text;  ///< standard output and error
};

Outcome execute(const TempFolder& folder, const std::string& command) {
    const fs::path log = folder / "log.txt";
    const int raw = std::system(fmt::format("{} >'{}' 2>&1", command, log.string()).c_str());
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, test::readFile(log)};
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line + ",");
    for (std::string field; std::getline(in, field, ',');)
        out.push_back(field);
    return out;
}

std::vector<std::vector<std::string>> readCsv(const fs::path& file) {
    std::vector<std::vector<std::string>> out;
    std::istringstream in(test::readFile(file));
    for (std::string line; std::getline(in, line);)
        out.push_back(split(line));
    return out;
}

/// Two video frames and a still of a synthetic scene, with the true high-resolution picture of
/// both.
void writeRecording(const fs::path& root, bool withTruth) {
    const bench::Workload work = bench::syntheticWorkload({160, 120}, {576, 432}, 2);
    Recorder recorder(root, work.rig, 30);
    const cv::Mat still = toRgba(work.stills[0]);
    ASSERT_TRUE(recorder.still(viewOf(still), {500}));
    for (std::size_t i = 0; i < work.frames.size(); ++i) {
        const Timestamp time{static_cast<std::int64_t>(1000 + i)};
        const cv::Mat frame = toRgba(work.frames[i]);
        ASSERT_TRUE(recorder.video(viewOf(frame), time));
        if (!withTruth) continue;
        cv::Mat truth;
        cv::resize(frame, truth, {576, 432}, 0, 0, cv::INTER_LANCZOS4);
        fs::create_directories(root / "truth" / "highres");
        savePng(root / "truth" / "highres" / fmt::format("{}.png", time.ns), viewOf(truth));
    }
    recorder.finish();
}

/// A texture and the same moved by (3, -2) pixels, with the flow that says so.
void writePair(const fs::path& folder) {
    const cv::Mat world = bench::syntheticWorkload({160, 120}, {320, 240}, 1).stills[0];
    const cv::Size size(160, 120);
    fs::create_directories(folder);
    savePicture(folder / "frame10.png", world(cv::Rect({40, 40}, size)).clone());
    savePicture(folder / "frame11.png", world(cv::Rect({37, 42}, size)).clone());
    FlowImage flow{{160, 120}, {}};
    flow.vectors.assign(160 * 120, {3, -2});
    saveFlo(folder / "flow10.flo", flow);
}

TEST(MfarEval, SuperResWritesItsColumnsAndTheMean) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const Outcome outcome =
        execute(folder, fmt::format("{0} superres {1}/tiny --degrade gain=0.9,noise=1 --csv "
                                    "{1}/out.csv --save {1}/pictures",
                                    MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 2 * 4 + 4) << outcome.text;
    EXPECT_EQ(rows[0], split("recording,frame,method,ms,psnr_db,ssim,lpc_si,hdrvdp_q,harm_rate"));
    for (std::size_t i = 1; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), rows[0].size());
        EXPECT_EQ(rows[i][0], "tiny");
        EXPECT_GT(std::stod(rows[i][3]), 0);
        EXPECT_GT(std::stod(rows[i][4]), 10);
        EXPECT_LE(std::stod(rows[i][5]), 1);
        EXPECT_TRUE(rows[i][6].empty() && rows[i][7].empty());
        EXPECT_LE(std::stod(rows[i][8]), 1);
    }
    EXPECT_EQ(rows[3][2], "bicubic");
    EXPECT_EQ(std::stod(rows[3][8]), 0);
    EXPECT_EQ(rows.back()[1], "mean");
    EXPECT_TRUE(fs::exists(folder / "pictures/tiny/1000_detail.png"));
    EXPECT_TRUE(fs::exists(folder / "pictures/tiny/1001_truth.png"));
}

TEST(MfarEval, FlowMeasuresAKnownShift) {
    const TempFolder folder;
    writePair(folder / "shift");
    const Outcome outcome = execute(folder, fmt::format("{0} flow {1}/shift --csv {1}/out.csv",
                                                        MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 7 + 7) << outcome.text;
    EXPECT_EQ(rows[0], split("recording,frame,method,ms,epe_px,bad1,bad2,coverage"));
    EXPECT_EQ(rows[1][2], "flow2d");
    EXPECT_EQ(rows[3][2], "dis-medium");
    EXPECT_LT(std::stod(rows[3][4]), 0.5);
    EXPECT_EQ(std::stod(rows[3][7]), 1);
}

TEST(MfarEval, WrongRequestsEndWithOneLineAndStatus2) {
    const TempFolder folder;
    const std::string dir = folder.path().string();
    writeRecording(folder / "tiny", false);
    const std::pair<std::string, std::string> cases[] = {
        {"superres " + dir + "/absent", "absent"},
        {"superres " + dir + "/tiny", "no truth"},
        {"superres " + dir + "/tiny --methods detail,wonder",
         "unknown method 'wonder' (valid: detail, blend, bicubic, paper)"},
        {"superres " + dir + "/tiny --degrade gain=0", "gain=0"},
        {"flow " + dir + "/absent", "no such folder"},
        {"flow " + dir + "/tiny", "no truth"},
        {"flow " + dir, "neither a recording"},
        {"depth " + dir, ""},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome outcome = execute(folder, std::string(MFAR_EVAL) + ' ' + arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_NE(outcome.text.find(message), std::string::npos) << outcome.text;
    }
}

TEST(MfarEval, TruthOfAnotherSizeIsRefused) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    savePicture(folder / "tiny/truth/highres/1000.png", cv::Mat(400, 576, CV_8UC3, {1, 2, 3}));
    const Outcome outcome = execute(folder, fmt::format("{} superres {}/tiny --methods bicubic",
                                                        MFAR_EVAL, folder.path().string()));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.text.find("1000.png: truth has 576x400 pixels, the output 576x432"),
              std::string::npos)
        << outcome.text;
}

}  // namespace
}  // namespace mfar::eval
