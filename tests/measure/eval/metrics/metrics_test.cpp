#include "tests/measure/eval/metrics/flow_error.h"
#include "tests/measure/eval/metrics/harm_rate.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/psnr.h"
#include "tests/measure/eval/metrics/ssim.h"
#include "tests/measure/eval/metrics/tiles_below.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace mfar::eval {
namespace {

cv::Mat constant(double value, cv::Size size = {32, 24}) {
    return {size, CV_64F, cv::Scalar(value)};
}

cv::Mat noise(cv::Size size = {64, 48}) {
    cv::Mat out(size, CV_64F);
    cv::RNG(7).fill(out, cv::RNG::UNIFORM, 0, 255);
    return out;
}

TEST(Luma, WeighsThePrimaryColoursByRec601) {
    const cv::Mat blue(1, 1, CV_8UC3, cv::Scalar(255, 0, 0));
    const cv::Mat green(1, 1, CV_8UC3, cv::Scalar(0, 255, 0));
    const cv::Mat red(1, 1, CV_8UC3, cv::Scalar(0, 0, 255));
    EXPECT_NEAR(luma(blue).at<double>(0), 29.07, 1e-9);
    EXPECT_NEAR(luma(green).at<double>(0), 149.685, 1e-9);
    EXPECT_NEAR(luma(red).at<double>(0), 76.245, 1e-9);
}

TEST(Luma, GreyPicturesKeepTheirValues) {
    const cv::Mat grey(2, 2, CV_8UC1, cv::Scalar(77));
    EXPECT_EQ(luma(grey).at<double>(1, 1), 77);
    EXPECT_THROW((void)luma(cv::Mat(2, 2, CV_16UC1)), std::invalid_argument);
}

TEST(Psnr, FollowsFromTheMeanSquaredError) {
    EXPECT_DOUBLE_EQ(meanSquaredError(constant(10), constant(15)), 25);
    EXPECT_NEAR(psnr(constant(10), constant(15)), 10 * std::log10(65025.0 / 25), 1e-12);
    EXPECT_NEAR(psnr(constant(0), constant(255)), 0, 1e-12);
}

TEST(Psnr, EqualPicturesHaveInfinitePsnr) {
    EXPECT_EQ(psnr(noise(), noise()), std::numeric_limits<double>::infinity());
}

TEST(Ssim, EqualPicturesScoreOne) {
    EXPECT_NEAR(ssim(noise(), noise()), 1, 1e-12);
}

TEST(Ssim, ForConstantPicturesOnlyTheLuminanceTermCounts) {
    const double c1 = 6.5025, x = 100, y = 150;
    EXPECT_NEAR(ssim(constant(x), constant(y)), (2 * x * y + c1) / (x * x + y * y + c1), 1e-9);
}

TEST(Ssim, InvertedStructureScoresNegative) {
    const cv::Mat picture = noise();
    EXPECT_LT(ssim(255 - picture, picture), -0.5);
}

TEST(HarmRate, CountsPixelsMoreThanTwoGreyLevelsWorseThanBicubic) {
    const cv::Mat truth = constant(100, {10, 10}), bicubic = constant(104, {10, 10});
    cv::Mat picture = truth.clone();
    EXPECT_EQ(harmRate(picture, bicubic, truth), 0);
    picture.at<double>(0, 0) = 106;  // two grey levels above bicubic's error: within the tolerance
    picture.at<double>(0, 1) = 106.5;
    picture.at<double>(0, 2) = 93;  // the sign of the error does not matter
    EXPECT_DOUBLE_EQ(harmRate(picture, bicubic, truth), 0.02);
}

TEST(TilesBelow, CountsCompleteTilesMoreThanAQuarterGreyLevelWorseThanBicubic) {
    const cv::Mat truth = constant(100, {5 * 64 + 63, 2 * 64 + 1}), bicubic = truth + 3;
    cv::Mat picture = truth - 3.2;  // 0.2 worse than bicubic: within the tolerance
    EXPECT_EQ(tilesBelow(picture, bicubic, truth), 0);
    picture(cv::Rect(64, 64, 64, 64)) = 96;
    picture(cv::Rect(5 * 64, 0, 63, 129)) = 0;
    picture(cv::Rect(0, 2 * 64, 64, 1)) = 0;
    EXPECT_DOUBLE_EQ(tilesBelow(picture, bicubic, truth), 0.1);
    EXPECT_EQ(tilesBelow(picture, bicubic, truth, 2), 0);
    EXPECT_EQ(tilesBelow(picture, bicubic, truth, 0), 1);
    EXPECT_EQ(tilesBelow(bicubic, picture, truth, 0), 0);
}

TEST(TilesBelow, OneBadPixelMakesATileWorse) {
    const cv::Mat truth = constant(100, {64, 64}), bicubic = truth + 0.5;
    cv::Mat picture = truth.clone();
    picture.at<double>(7, 9) = 200;  // RMS error 100 / 64 exceeds bicubic's 0.5 by more than 0.25
    EXPECT_EQ(tilesBelow(picture, bicubic, truth), 1);
}

TEST(TilesBelow, WithoutCompleteTilesTheShareIsNan) {
    EXPECT_TRUE(std::isnan(tilesBelow(constant(1), constant(2), constant(3))));
}

TEST(FlowError, MeasuresEndPointErrorAndSharesOfWrongPixels) {
    const cv::Mat truth(1, 4, CV_32FC2, cv::Scalar(1, 2));
    cv::Mat flow = truth.clone();
    flow.at<cv::Vec2f>(0, 1) += cv::Vec2f(0.3F, 0.4F);
    flow.at<cv::Vec2f>(0, 2) += cv::Vec2f(1.5F, 0);
    flow.at<cv::Vec2f>(0, 3) += cv::Vec2f(3, 4);
    const FlowError error = flowError(flow, truth);
    EXPECT_EQ(error.known, 4U);
    EXPECT_NEAR(error.epe, (0 + 0.5 + 1.5 + 5) / 4, 1e-6);
    EXPECT_DOUBLE_EQ(error.bad1, 0.5);
    EXPECT_DOUBLE_EQ(error.bad2, 0.25);
    EXPECT_DOUBLE_EQ(error.coverage, 1);
}

TEST(FlowError, AngularErrorIsMeasuredInSpaceAndTime) {
    const cv::Mat truth(1, 2, CV_32FC2, cv::Scalar(0, 0));
    cv::Mat flow = truth.clone();
    EXPECT_EQ(flowError(flow, truth).angular, 0);
    flow.at<cv::Vec2f>(0, 1) = {0, -1};
    EXPECT_NEAR(flowError(flow, truth).angular, 45 / 2.0, 1e-6);
}

TEST(FlowSparsification, AreaIsZeroIfConfidenceFallsAsErrorsRise) {
    const cv::Mat truth(1, 4, CV_32FC2, cv::Scalar(1, 2));
    cv::Mat flow = truth.clone();
    flow.at<cv::Vec2f>(0, 1) += cv::Vec2f(1, 0);
    flow.at<cv::Vec2f>(0, 2) += cv::Vec2f(0, 3);
    flow.at<cv::Vec2f>(0, 3) = {std::nanf(""), 0};  // pixels without a result do not count
    const cv::Mat right = (cv::Mat_<float>(1, 4) << 0.9F, 0.5F, 0.1F, 0);
    EXPECT_NEAR(flowSparsification(flow, truth, right).ause, 0, 1e-9);
    EXPECT_GT(flowSparsification(flow, truth, 1 - right).ausePerRandom, 1);
}

TEST(FlowError, UnknownTruthIsIgnoredAndMissingResultsCountAsWrong) {
    cv::Mat truth(1, 4, CV_32FC2, cv::Scalar(0, 0)), flow = truth.clone();
    truth.at<cv::Vec2f>(0, 0) = {1.6e9F, 1.6e9F};
    truth.at<cv::Vec2f>(0, 1) = {std::nanf(""), 0};
    flow.at<cv::Vec2f>(0, 2) = {std::nanf(""), 0};
    const FlowError error = flowError(flow, truth);
    EXPECT_EQ(error.known, 2U);
    EXPECT_DOUBLE_EQ(error.epe, 0);
    EXPECT_DOUBLE_EQ(error.bad1, 0.5);
    EXPECT_DOUBLE_EQ(error.coverage, 0.5);
}

TEST(FlowError, WithoutAnyKnownTruthTheErrorIsNan) {
    const cv::Mat truth(2, 2, CV_32FC2, cv::Scalar(2e9, 2e9));
    const FlowError error = flowError(truth, truth);
    EXPECT_EQ(error.known, 0U);
    EXPECT_TRUE(std::isnan(error.epe));
}

}  // namespace
}  // namespace mfar::eval
