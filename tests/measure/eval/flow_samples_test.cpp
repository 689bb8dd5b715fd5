#include "hal/virtual/image_files.h"
#include "hal/virtual/recorder.h"
#include "tests/measure/eval/flow_samples.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/report.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>
#include <opencv2/video/tracking.hpp>

namespace mfar::eval {
namespace {

using test::TempFolder;

void writePicture(const std::filesystem::path& file, cv::Size size = {24, 16}) {
    savePicture(file, cv::Mat(size, CV_8UC3, cv::Scalar(10, 20, 30)));
}

void writeFlow(const std::filesystem::path& file, cv::Size size = {24, 16}) {
    ASSERT_TRUE(cv::writeOpticalFlow(file.string(), cv::Mat(size, CV_32FC2, cv::Scalar(1, -2))));
}

TEST(FlowSamples, AFlowFileBelongsToTheFrameOfItsNumberAndTheNextFrame) {
    const TempFolder folder;
    for (const char* name : {"frame07.png", "frame10.png", "frame12.png"})
        writePicture(folder / name);
    writeFlow(folder / "flow10.flo");
    const FlowSet set = flowSamplesOf(folder.path());
    ASSERT_EQ(set.samples.size(), 1U);
    EXPECT_EQ(set.samples[0].frame, "10");
    EXPECT_EQ(set.samples[0].video.filename(), "frame10.png");
    EXPECT_EQ(set.samples[0].still.filename(), "frame12.png");
    EXPECT_EQ(set.rig.still.size, (Size{24, 16}));
    EXPECT_EQ(loadFrame(set, set.samples[0]).picture.type(), CV_8UC3);
    EXPECT_EQ(loadStill(set, set.samples[0]).pose, std::nullopt);
    EXPECT_EQ(loadTruth(set, set.samples[0]).at<cv::Vec2f>(3, 4), cv::Vec2f(1, -2));
}

TEST(FlowSamples, AFlowFileWithoutItsFramesIsNamedInTheError) {
    const TempFolder folder;
    EXPECT_THROW((void)flowSamplesOf(folder.path()), EvalError);
    EXPECT_THROW((void)flowSamplesOf(folder / "absent"), EvalError);
    writePicture(folder / "frame10.png");
    writeFlow(folder / "flow10.flo");
    try {
        (void)flowSamplesOf(folder.path());
        FAIL() << "a pair without its second frame was accepted";
    } catch (const EvalError& e) {
        EXPECT_NE(std::string(e.what()).find("flow10.flo"), std::string::npos);
    }
}

TEST(FlowSamples, SizesThatDifferAndBrokenFilesAreRefused) {
    const TempFolder folder;
    writePicture(folder / "frame10.png");
    writePicture(folder / "frame11.png", {24, 15});
    writeFlow(folder / "flow10.flo", {23, 16});
    const FlowSet set = flowSamplesOf(folder.path());
    EXPECT_THROW((void)loadTruth(set, set.samples.at(0)), EvalError);
    EXPECT_THROW((void)loadStill(set, set.samples.at(0)), EvalError);
    test::writeFile(folder / "flow10.flo", "PIEH");
    EXPECT_THROW((void)loadTruth(set, set.samples.at(0)), ImageFileError);
}

StereoRig smallRig() {
    StereoRig rig;
    rig.video = {{24, 16}, 20, 20, 11.5, 7.5, {}};
    rig.still = rig.video.scaledTo({72, 48});
    rig.T_still_video.translation = {-0.1, 0, 0};
    return rig;
}

/// Writes frames at 100 and 200 ns, with poses if `poses`, and a still at 150 ns.
void writeRecording(const std::filesystem::path& root, bool poses = false) {
    Recorder recorder(root, smallRig(), 30);
    const cv::Mat frame(16, 24, CV_8UC4, cv::Scalar::all(50));
    const cv::Mat still(48, 72, CV_8UC4, cv::Scalar::all(80));
    for (const Timestamp time : {Timestamp{100}, Timestamp{200}}) {
        ASSERT_TRUE(recorder.video(viewOf(frame), time));
        const double x = 1e-3 * static_cast<double>(time.ns);
        if (!poses) continue;
        ASSERT_TRUE(recorder.pose({time, {Eigen::Quaterniond::Identity(), {x, 0, 0}}}));
    }
    ASSERT_TRUE(recorder.still(viewOf(still), {150}));
    recorder.finish();
    std::filesystem::create_directories(root / "truth/flow");
    std::filesystem::create_directories(root / "truth/inverse_depth");
}

void writeDepth(const std::filesystem::path& file, float inverseDepth, Size size = {24, 16}) {
    savePfm(file, {size, std::vector<float>(static_cast<std::size_t>(size.width) * size.height,
                                            inverseDepth)});
}

TEST(FlowSamples, ARecordingWithoutTruthIsRefused) {
    const TempFolder folder;
    writeRecording(folder / "r");
    EXPECT_THROW((void)flowSamplesOf(folder / "r"), EvalError);
    // The flow to a still of another time follows from depth only if both poses are known.
    writeDepth(folder / "r/truth/inverse_depth/100.pfm", 1);
    EXPECT_THROW((void)flowSamplesOf(folder / "r"), EvalError);
}

TEST(FlowSamples, TrueFlowToAStillIsPreferredToDepthAndToFlowBetweenFrames) {
    const TempFolder folder;
    const auto truth = folder / "r/truth";
    writeRecording(folder / "r", true);
    writeFlow(truth / "flow/100_200.flo");
    const FlowSet toVideo = flowSamplesOf(folder / "r");
    ASSERT_EQ(toVideo.samples.size(), 1U);
    EXPECT_EQ(toVideo.samples[0].frame, "100_200");
    EXPECT_EQ(loadStill(toVideo, toVideo.samples[0]).picture.size(), cv::Size(24, 16));
    EXPECT_EQ(toVideo.rig.T_still_video.translation.norm(), 0);

    writeDepth(truth / "inverse_depth/200.pfm", 2);
    const FlowSet byDepth = flowSamplesOf(folder / "r");
    ASSERT_EQ(byDepth.samples.size(), 1U);
    EXPECT_EQ(byDepth.samples[0].frame, "200_150");
    EXPECT_EQ(byDepth.samples[0].truth.extension(), ".pfm");

    writeFlow(truth / "flow/200_150.flo");
    writeFlow(truth / "flow/100_150.flo");
    const FlowSet toStill = flowSamplesOf(folder / "r");
    ASSERT_EQ(toStill.samples.size(), 2U);
    EXPECT_EQ(toStill.samples[0].frame, "100_150");
    EXPECT_EQ(toStill.samples[1].frame, "200_150");
    const Shot still = loadStill(toStill, toStill.samples[1]);
    EXPECT_EQ(still.picture.size(), cv::Size(72, 48));
    EXPECT_NEAR(still.pose.value().T_world_video.translation.x(), 0.15, 1e-12);

    const FlowSet depth = depthSamplesOf(folder / "r");
    ASSERT_EQ(depth.samples.size(), 1U);
    EXPECT_EQ(depth.samples[0].frame, "200_150");
    EXPECT_EQ(depth.samples[0].truth.extension(), ".pfm");
}

TEST(FlowSamples, FlowFromDepthContainsTheParallaxOfRigAndMotion) {
    const TempFolder folder;
    writeRecording(folder / "r", true);
    writeDepth(folder / "r/truth/inverse_depth/200.pfm", 2);
    const FlowSet set = flowSamplesOf(folder / "r");
    // At 150 ns, the rig was 0.05 m to the left of its position at 200 ns. Its still camera is
    // 0.1 m to the right of the video camera.
    const auto v = loadTruth(set, set.samples.at(0)).at<cv::Vec2f>(8, 12);
    EXPECT_NEAR(v[0], 20 * 2 * (0.05 - 0.1), 1e-5);
    EXPECT_NEAR(v[1], 0, 1e-6);
    writeDepth(folder / "r/truth/inverse_depth/200.pfm", 2, {24, 15});
    EXPECT_THROW((void)loadTruth(set, set.samples.at(0)), EvalError);
}

TEST(FlowSamples, FlowFilesNotNamedAfterTheTimesOfTwoPicturesAreRefused) {
    const TempFolder folder;
    writeRecording(folder / "r");
    for (const char* name : {"100_175.flo", "100.flo", "100_.flo", "_150.flo", "-100_150.flo",
                             "100_150x.flo", "100_99999999999999999999.flo"}) {
        writeFlow(folder / "r/truth/flow" / name);
        EXPECT_THROW((void)flowSamplesOf(folder / "r"), EvalError) << name;
        std::filesystem::remove(folder / "r/truth/flow" / name);
    }
}

}  // namespace
}  // namespace mfar::eval
