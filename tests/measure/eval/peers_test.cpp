#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/psnr.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/rig_resample.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace mfar::eval {
namespace {

StereoRig plainRig() {
    StereoRig rig;
    rig.video = {{160, 120}, 150, 150, 79.5, 59.5, {}};
    rig.still = rig.video.scaledTo({480, 360});
    return rig;
}

/// Blobs of many sizes. Every region looks different, and no detail is finer than two pixels.
cv::Mat texture(cv::Size size) {
    cv::Mat out(size, CV_32FC3, cv::Scalar::all(0));
    for (const int cell : {3, 9, 27}) {
        cv::Mat coarse(size.height / cell + 2, size.width / cell + 2, CV_32FC3), fine;
        cv::RNG(static_cast<std::uint64_t>(cell)).fill(coarse, cv::RNG::UNIFORM, 0, 85);
        cv::resize(coarse, fine, {coarse.cols * cell, coarse.rows * cell}, 0, 0, cv::INTER_CUBIC);
        out += fine(cv::Rect({0, 0}, size));
    }
    out.convertTo(out, CV_8U);
    return out;
}

TEST(RigResample, OutputHasTheStillsWidthAndTheVideosAspectRatio) {
    StereoRig rig = plainRig();
    rig.video.size = {640, 480};
    rig.still.size = {2304, 1536};
    EXPECT_EQ(outputSize(rig), (Size{2304, 1728}));
}

TEST(RigResample, WithEqualLensesTheMapOnlyScales) {
    const cv::Mat map = stillMap(plainRig(), {160, 120});
    const auto& p = map.at<cv::Vec2f>(10, 20);
    EXPECT_NEAR(p[0], 20.5 * 3 - 0.5, 1e-4);
    EXPECT_NEAR(p[1], 10.5 * 3 - 0.5, 1e-4);
}

TEST(RigResample, ARotatedStillCameraShiftsTheMap) {
    StereoRig rig = plainRig();
    // The still camera looks 2 degrees to the right of the video camera. So the centre of the
    // video's view lies to the left of the still's centre.
    rig.T_still_video.rotation = Eigen::AngleAxisd(-2 * CV_PI / 180, Eigen::Vector3d::UnitY());
    const cv::Mat map = stillMap(rig, {160, 120});
    const double expected = rig.still.cx - rig.still.fx * std::tan(2 * CV_PI / 180);
    const cv::Vec2f middle = (map.at<cv::Vec2f>(59, 79) + map.at<cv::Vec2f>(60, 80)) * 0.5F;
    EXPECT_NEAR(middle[0], expected, 0.05);
    EXPECT_NEAR(middle[1], rig.still.cy, 0.05);
}

TEST(RigResample, TheStillIsReducedByAreaMeans) {
    const cv::Mat still = texture({480, 360});
    cv::Mat mean;
    cv::resize(still, mean, {160, 120}, 0, 0, cv::INTER_AREA);
    EXPECT_LE(cv::norm(resampleStill(still, plainRig()), mean, cv::NORM_INF), 1);
}

TEST(TwoWayConfidence, FallsLinearlyAndIsZeroWhereTheFlowLeavesThePicture) {
    const cv::Mat forward(8, 8, CV_32FC2, cv::Scalar(1, 0));
    const cv::Mat backward(8, 8, CV_32FC2, cv::Scalar(-0.5, 0));
    const cv::Mat conf = twoWayConfidence(forward, backward, 2);
    EXPECT_NEAR(conf.at<float>(4, 3), 0.75, 1e-6);
    EXPECT_EQ(conf.at<float>(4, 7), 0);  // the flow leads to x = 8, outside the picture
    EXPECT_EQ(twoWayConfidence(forward, backward, 0.25).at<float>(4, 3), 0);
}

TEST(PaperPipeline, AStillOfTheSameViewAddsDetail) {
    const StereoRig rig = plainRig();
    const cv::Mat still = texture({480, 360});
    cv::Mat video, bicubic;
    cv::resize(still, video, {160, 120}, 0, 0, cv::INTER_AREA);
    cv::resize(video, bicubic, still.size(), 0, 0, cv::INTER_CUBIC);
    PaperPipeline paper(rig, {480, 360});
    paper.setStill(still);
    const double ours = psnr(luma(paper.run(video)), luma(still));
    EXPECT_GT(ours, psnr(luma(bicubic), luma(still)) + 6);
    EXPECT_GT(cv::mean(paper.confidence())[0], 0.9);
}

TEST(PaperPipeline, AShiftedStillAddsDetail) {
    const StereoRig rig = plainRig();
    const cv::Mat scene = texture({540, 420});
    const cv::Mat truth = scene(cv::Rect(30, 30, 480, 360)).clone();
    const cv::Mat still = scene(cv::Rect(42, 24, 480, 360)).clone();
    cv::Mat video, bicubic;
    cv::resize(truth, video, {160, 120}, 0, 0, cv::INTER_AREA);
    cv::resize(video, bicubic, truth.size(), 0, 0, cv::INTER_CUBIC);
    PaperPipeline paper(rig, {480, 360});
    paper.setStill(still);
    const cv::Rect inner(48, 48, 384, 264);
    const double ours = psnr(luma(paper.run(video)(inner)), luma(truth(inner)));
    EXPECT_GT(ours, psnr(luma(bicubic(inner)), luma(truth(inner))) + 3);
}

}  // namespace
}  // namespace mfar::eval
