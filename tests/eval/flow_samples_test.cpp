#include "hal/virtual/image_files.h"
#include "hal/virtual/recorder.h"
#include "tests/eval/flow_samples.h"
#include "tests/eval/picture.h"
#include "tests/eval/report.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/video/tracking.hpp>

namespace mfar::eval {
namespace {

using test::TempFolder;

void writePicture(const std::filesystem::path& file, cv::Size size = {24, 16}) {
    ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(size, CV_8UC3, cv::Scalar(10, 20, 30))));
}

void writeFlow(const std::filesystem::path& file, cv::Size size = {24, 16}) {
    ASSERT_TRUE(cv::writeOpticalFlow(file.string(), cv::Mat(size, CV_32FC2, cv::Scalar(1, -2))));
}

TEST(FlowSamples, AFlowBelongsToItsFrameAndTheNext) {
    const TempFolder folder;
    for (const char* name : {"frame07.png", "frame10.png", "frame12.png"})
        writePicture(folder / name);
    writeFlow(folder / "flow10.flo");
    const auto samples = flowSamplesOf(folder.path());
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0].frame, "10");
    EXPECT_EQ(samples[0].a.filename(), "frame10.png");
    EXPECT_EQ(samples[0].b.filename(), "frame12.png");
    const FlowPictures pictures = loadFlowPictures(samples[0]);
    EXPECT_EQ(pictures.a.type(), CV_8UC1);
    EXPECT_EQ(pictures.truth.at<cv::Vec2f>(3, 4), cv::Vec2f(1, -2));
}

TEST(FlowSamples, MissingPartsAreNamed) {
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
    writePicture(folder / "frame11.png");
    writeFlow(folder / "flow10.flo", {23, 16});
    const auto sample = flowSamplesOf(folder.path()).at(0);
    EXPECT_THROW((void)loadFlowPictures(sample), EvalError);
    test::writeFile(folder / "flow10.flo", "PIEH");
    EXPECT_THROW((void)loadFlowPictures(sample), ImageFileError);
}

TEST(FlowSamples, ARecordingsFlowLeadsToTheStillInTheVideosGeometry) {
    const TempFolder folder;
    StereoRig rig;
    rig.video = {{24, 16}, 20, 20, 11.5, 7.5, {}};
    rig.still = rig.video.scaledTo({72, 48});
    Recorder recorder(folder / "r", rig, 30);
    const cv::Mat frame(16, 24, CV_8UC4, cv::Scalar::all(50));
    const cv::Mat still(48, 72, CV_8UC4, cv::Scalar::all(80));
    ASSERT_TRUE(recorder.video(viewOf(frame), {100}));
    ASSERT_TRUE(recorder.video(viewOf(frame), {200}));
    ASSERT_TRUE(recorder.still(viewOf(still), {150}));
    recorder.finish();
    EXPECT_THROW((void)flowSamplesOf(folder / "r"), EvalError);
    std::filesystem::create_directories(folder / "r/truth/flow");
    writeFlow(folder / "r/truth/flow/200_150.flo");
    writeFlow(folder / "r/truth/flow/100_200.flo");
    const auto samples = flowSamplesOf(folder / "r");
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[0].frame, "100_200");
    EXPECT_EQ(samples[1].frame, "200_150");
    const FlowPictures toVideo = loadFlowPictures(samples[0]);
    const FlowPictures toStill = loadFlowPictures(samples[1]);
    EXPECT_EQ(toVideo.b.at<std::uint8_t>(8, 12), 50);
    EXPECT_EQ(toStill.b.size(), cv::Size(24, 16));
    EXPECT_EQ(toStill.b.at<std::uint8_t>(8, 12), 80);
    for (const char* name : {"100_175.flo", "100.flo", "100_.flo", "_150.flo", "-100_150.flo",
                             "100_150x.flo", "100_99999999999999999999.flo"}) {
        writeFlow(folder / "r/truth/flow" / name);
        EXPECT_THROW((void)flowSamplesOf(folder / "r"), EvalError) << name;
        std::filesystem::remove(folder / "r/truth/flow" / name);
    }
}

}  // namespace
}  // namespace mfar::eval
