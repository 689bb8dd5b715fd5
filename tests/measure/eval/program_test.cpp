#include "tests/measure/bench/xml_check.h"
#include "tests/measure/eval/tiny_recording.h"

#include <array>
#include <cmath>

/// Runs mfar-eval on tiny pictures. Accuracy is checked only roughly, and speed not at all.
namespace mfar::eval {
namespace {

using test::execute;
using test::Outcome;
using test::TempFolder;
namespace fs = std::filesystem;

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

TEST(MfarEval, MetricComparesTwoPictures) {
    const TempFolder folder;
    const cv::Mat picture = bench::syntheticWorkload({160, 120}, {320, 240}, 1).stills[0];
    cv::Mat blurred;
    cv::GaussianBlur(picture, blurred, {0, 0}, 1);
    savePicture(folder / "sharp.png", picture);
    savePicture(folder / "soft.png", blurred);
    const auto row = [&](const std::string& options) {
        const Outcome outcome =
            execute(folder, fmt::format("{0} metric {1}/soft.png {1}/sharp.png {2} --csv "
                                        "{1}/out.csv",
                                        MFAR_EVAL, folder.path().string(), options));
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const auto rows = readCsv(folder / "out.csv");
        EXPECT_EQ(rows.size(), 2U);
        return rows.at(1);
    };
    const auto some = row("--metrics psnr,hdrvdp"), colour = row("--metrics psnr,hdrvdp --colour");
    EXPECT_EQ(some[0], "sharp.png");
    EXPECT_EQ(some[1], "soft.png");
    EXPECT_EQ(some[3], colour[3]);
    EXPECT_NE(some[6], colour[6]);
    EXPECT_TRUE(some[4].empty() && some[5].empty());
    EXPECT_TRUE(colour.back().empty());
}

TEST(MfarEval, Figure7OfARecordingIsReportedAndDrawn) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    const Outcome outcome =
        execute(folder, fmt::format("{0} figure7 {1}/tiny --recordings-only --frames 1 --csv "
                                    "{1}/out.csv --svg {1}/out.svg",
                                    MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("tiny: HDR-VDP-2 Q"), std::string::npos) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 6 + 6);
    EXPECT_EQ(rows[1][2], "truth");
    EXPECT_EQ(std::stod(rows[1][4]), 100);
    EXPECT_NE(test::readFile(folder / "out.svg").find(">tiny<"), std::string::npos);
}

TEST(MfarEval, FlowMeasuresAKnownShift) {
    const TempFolder folder;
    writePair(folder / "shift");
    const Outcome outcome =
        execute(folder, fmt::format("{0} flow {1}/shift --csv {1}/out.csv --svg {1}/out.svg",
                                    MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(bench::test::isWellFormed(test::readFile(folder / "out.svg")));
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 10 + 10) << outcome.text;
    EXPECT_EQ(rows[0], split("recording,frame,method,ms,epe_px,bad1,bad2,coverage,angular_deg,"
                             "ause,ause_rel"));
    EXPECT_LT(std::stod(rows[4].at(8)), 5);
    EXPECT_TRUE(rows[4].at(9).empty());  // dis-medium has no confidence, so ause is empty
    EXPECT_EQ(rows[5][2], "dis-medium-both");
    EXPECT_GE(std::stod(rows[5].at(10)), 0);
    EXPECT_EQ(rows[1][2], "epipolar");
    EXPECT_EQ(rows[2][2], "flow2d");
    EXPECT_EQ(rows[4][2], "dis-medium");
    EXPECT_LT(std::stod(rows[4][4]), 0.5);
    EXPECT_EQ(std::stod(rows[4][7]), 1);
    EXPECT_EQ(rows[10][2], "shift");
    EXPECT_LT(std::stod(rows[10][4]), 0.5);
}

/// Records a flat wall at 2 m, of which both sensors take a picture at the same time. The recording
/// has inverse depth and a baseline, but no flow.
void writeStereo(const fs::path& root) {
    const cv::Mat world = bench::syntheticWorkload({160, 120}, {320, 240}, 1).stills[0];
    const cv::Size size(160, 120);
    StereoRig rig;
    rig.video = {{160, 120}, 160, 160, 79.5, 59.5, {}};
    rig.still = rig.video;
    rig.T_still_video.translation = {-0.1, 0, 0};  // 8 px of parallax
    Recorder recorder(root, rig, 30);
    const cv::Mat left = toRgba(world(cv::Rect({40, 40}, size)).clone());
    const cv::Mat right = toRgba(world(cv::Rect({48, 40}, size)).clone());
    ASSERT_TRUE(recorder.video(viewOf(left), {1000}));
    ASSERT_TRUE(recorder.still(viewOf(right), {1000}));
    recorder.finish();
    fs::create_directories(root / "truth/inverse_depth");
    savePfm(root / "truth/inverse_depth/1000.pfm",
            {{160, 120}, std::vector<float>(160 * 120, 0.5F)});
}

TEST(MfarEval, FlowErrorGrowsWithDegradationAndPoseNoise) {
    const TempFolder folder;
    writeStereo(folder / "wall");
    const auto bad1 = [&](const std::string& options) {
        const Outcome outcome = execute(
            folder, fmt::format("{0} flow {1}/wall --methods flow2d,dis-medium,sgbm {2} --csv "
                                "{1}/out.csv",
                                MFAR_EVAL, folder.path().string(), options));
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const auto rows = readCsv(folder / "out.csv");
        EXPECT_EQ(rows.size(), 1U + 3 + 3) << outcome.text;
        std::vector<double> out;
        for (std::size_t i = 1; i < rows.size() && i < 4; ++i) {
            EXPECT_EQ(rows[i][1], "1000_1000");
            out.push_back(std::stod(rows[i].at(5)));
        }
        out.resize(3, -1);
        return out;
    };
    const auto clean = bad1(""), worse = bad1("--degrade gain=0.3,noise=25");
    const auto off = bad1("--pose-noise-deg 3"), other = bad1("--pose-noise-deg 3 "
                                                              "--pose-noise-seed 1");
    for (const double share : clean)
        EXPECT_LT(share, 0.05);
    EXPECT_GT(worse[1], clean[1] + 0.05);
    EXPECT_EQ(off[1], clean[1]);
    EXPECT_GT(off[2], 0.5);
    EXPECT_GT(other[2], 0.5);
    EXPECT_NE(off[2], other[2]);
}

TEST(MfarEval, EveryDepthMethodMeasuresAFlatWall) {
    const TempFolder folder;
    writeStereo(folder / "wall");
    const Outcome outcome = execute(folder, fmt::format("{0} depth {1}/wall --csv {1}/out.csv",
                                                        MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto rows = readCsv(folder / "out.csv");
    ASSERT_EQ(rows.size(), 1U + 5 + 5) << outcome.text;
    EXPECT_EQ(rows[0],
              split("recording,frame,method,ms,absrel,bad1,completeness,edge_absrel,"
                    "edge_bad1,inner_absrel,inner_bad1,delta1,delta2,delta3,ause,ause_rel"));
    const char* names[] = {"depth", "flow", "midpoint", "sgbm", "stereobm"};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(rows[i + 1][2], names[i]);
        EXPECT_GT(std::stod(rows[i + 1][3]), 0);
        EXPECT_LT(std::stod(rows[i + 1][4]), 0.05) << names[i];
        EXPECT_LT(std::stod(rows[i + 1][5]), 0.2) << names[i];
        EXPECT_GT(std::stod(rows[i + 1][6]), 0.8) << names[i];
        EXPECT_TRUE(rows[i + 1][7].empty());  // a flat wall has no depth edges
        EXPECT_GT(std::stod(rows[i + 1][11]), 0.8);
        EXPECT_GE(std::stod(rows[i + 1][13]), std::stod(rows[i + 1][11]));
        EXPECT_EQ(rows[i + 1].at(15).empty(), i != 0);  // only `depth` reports a variance
    }
    const Outcome blind = execute(
        folder, fmt::format("{0} depth {1}/wall --methods flow --poses none --csv {1}/out.csv",
                            MFAR_EVAL, folder.path().string()));
    ASSERT_EQ(blind.status, 0) << blind.text;
    EXPECT_EQ(std::stod(readCsv(folder / "out.csv").at(1).at(6)), 0);  // depth needs poses
}

TEST(MfarEval, WithoutPosesEpipolarFlowEqualsFlow2d) {
    const TempFolder folder;
    writeStereo(folder / "wall");
    const auto epe = [&](const std::string& source) {
        const Outcome outcome = execute(
            folder, fmt::format("{0} flow {1}/wall --methods epipolar,flow2d --poses {2} --csv "
                                "{1}/out.csv",
                                MFAR_EVAL, folder.path().string(), source));
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        const auto rows = readCsv(folder / "out.csv");
        return std::pair(rows.at(1).at(4), rows.at(2).at(4));
    };
    const auto recorded = epe("recorded"), none = epe("none");
    EXPECT_NE(recorded.first, recorded.second);
    EXPECT_EQ(none.first, none.second);
    EXPECT_EQ(none.second, recorded.second);
}

TEST(MfarEval, InvalidRequestsEndWithAMessageAndStatus2) {
    const TempFolder folder;
    const std::string dir = folder.path().string();
    writeRecording(folder / "tiny", false);
    writeRecording(folder / "truth", true);
    writePair(folder / "pair");
    const std::pair<std::string, std::string> cases[] = {
        {"superres " + dir + "/absent", "absent"},
        {"superres " + dir + "/tiny", "no truth"},
        {"superres " + dir + "/tiny --methods detail,wonder",
         "unknown method 'wonder' (valid: detail, detail2d, blend, bilinear, "
         "bicubic, lanczos, paper)"},
        {"superres " + dir + "/tiny --degrade gain=0", "gain=0"},
        {"superres " + dir + "/tiny --classes --no-still", "--classes"},
        {"superres " + dir + "/truth --methods bicubic --dnn-model x4.pb",
         "x4.pb: a model's file name must be"},
        {"superres " + dir + "/tiny --degrade-video blur=-1", "--degrade-video: 'blur=-1'"},
        {"flow " + dir + "/absent", "no such folder"},
        {"flow " + dir + "/tiny", "no truth"},
        {"flow " + dir, "neither a recording"},
        {"flow " + dir + "/tiny --degrade noise=-1", "noise=-1"},
        {"flow " + dir + "/tiny --pose-noise-deg 181", "--pose-noise-deg"},
        {"superres " + dir + "/tiny --pose-noise-deg nan", "--pose-noise-deg"},
        {"superres " + dir + "/tiny --alpha nan", "--alpha"},
        {"superres " + dir + "/tiny --pose-noise-seed -1", "--pose-noise-seed"},
        {"superres " + dir + "/tiny --poses none --pose-noise-deg 1", "--pose-noise-deg needs"},
        {"flow " + dir + "/tiny --pose-noise-seed 1", "--pose-noise-deg"},
        {"superres " + dir + "/tiny --no-still --stills 2", "--stills"},
        {"superres " + dir + "/truth --no-still --methods paper,blend", "no method remains"},
        {"flow " + dir + "/pair --csv " + dir + "/absent/x.csv", "its folder does not exist"},
        {"flow " + dir + "/pair --csv " + dir, "is a folder"},
        {"flow " + dir + "/pair --csv " + dir + "/x --svg " + dir + "/x", "the same file"},
        {"superres " + dir + "/tiny --poses guessed", "--poses"},
        {"superres " + dir + "/truth --poses tags", "tags.toml: is missing"},
        {"flow " + dir + "/pair --poses tags", "--poses tags needs a recording"},
        {"depth " + dir + "/absent", "no such folder"},
        {"depth " + dir + "/tiny", "no truth"},
        {"depth " + dir + "/pair", "pair"},
        {"depth " + dir + "/tiny --methods depths", "unknown method 'depths'"},
        {"metric " + dir + "/pair/frame10.png " + dir + "/absent.png", "absent.png"},
        {"metric " + dir + "/pair/frame10.png " + dir + "/pair/frame11.png", "msssim needs"},
        {"metric a.png b.png --metrics sharpness", "sharpness"},
        {"figure7 --recordings-only", "needs a scene"},
        {"figure7 --scenes mars", "mars"},
        {"metric a.png b.png --ppd nan", "--ppd"},
        {"warp " + dir, ""},
    };
    for (const auto& [arguments, message] : cases) {
        const Outcome outcome = execute(folder, std::string(MFAR_EVAL) + ' ' + arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_NE(outcome.text.find(message), std::string::npos) << outcome.text;
    }
}

TEST(MfarEval, UnwritableStandardOutputIsReported) {
    const TempFolder folder;
    writePair(folder / "pair");
    for (const std::string& arguments :
         {std::string("--help"), "flow " + (folder / "pair").string() + " --methods shift"}) {
        const std::string command = fmt::format("({} {} >/dev/full)", MFAR_EVAL, arguments);
        const Outcome outcome = execute(folder, command);
        EXPECT_EQ(outcome.status, 1) << arguments;
        EXPECT_NE(outcome.text.find("mfar-eval: "), std::string::npos) << outcome.text;
    }
}

TEST(MfarEval, ATruePictureOfAnotherSizeIsRefused) {
    const TempFolder folder;
    writeRecording(folder / "tiny", true);
    savePicture(folder / "tiny/truth/highres/1000.png", cv::Mat(400, 576, CV_8UC3, {1, 2, 3}));
    const Outcome outcome = execute(folder, fmt::format("{} superres {}/tiny --methods bicubic",
                                                        MFAR_EVAL, folder.path().string()));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.text.find(
                  "1000.png: the true picture has 576x400 pixels, but the output has 576x432"),
              std::string::npos)
        << outcome.text;
}

}  // namespace
}  // namespace mfar::eval
