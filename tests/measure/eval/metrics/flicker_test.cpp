#include "tests/measure/eval/metrics/flicker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mfar::eval {
namespace {

constexpr int kBorder = 8;

cv::Mat noise(double sigma, int seed, cv::Size size = {240, 176}) {
    cv::Mat out(size, CV_64F);
    cv::RNG(static_cast<std::uint64_t>(seed)).fill(out, cv::RNG::NORMAL, 0, sigma);
    return out;
}

cv::Mat flowOf(float x, float y) {
    return {48, 64, CV_32FC2, cv::Scalar(x, y)};
}

TEST(Flicker, ErrorsThatMoveWithTheirScenePointDoNotFlicker) {
    const cv::Mat all = noise(5, 1, {248, 180});
    const cv::Mat before = all(cv::Rect(8, 4, 240, 176)), after = all(cv::Rect(0, 0, 240, 176));
    EXPECT_NEAR(flicker(before, after, flowOf(2, 1), kBorder), 0, 1e-9) << "motion of the errors";
    EXPECT_GT(flicker(before, after, flowOf(0, 0), kBorder), 4);
    EXPECT_GT(flicker(before, after, flowOf(1, 2), kBorder), 4) << "x and y exchanged";
}

TEST(Flicker, IndependentErrorsGiveTheirStandardDeviation) {
    EXPECT_NEAR(flicker(noise(3, 1), noise(3, 2), flowOf(0, 0), kBorder), 3, 0.05);
}

TEST(Flicker, OnlyPointsInBothPicturesCount) {
    cv::Mat flow = flowOf(0, 0);
    flow.at<cv::Vec2f>(20, 30) = {std::numeric_limits<float>::quiet_NaN(), 0};
    flow.at<cv::Vec2f>(20, 31) = {1e10F, 0};
    cv::Mat before(176, 240, CV_64F, cv::Scalar(0)), after = before.clone();
    after(cv::Rect(30 * 4 - kBorder, 20 * 4 - kBorder, 8, 4)) = 100;
    EXPECT_NEAR(flicker(before, after, flow, kBorder), 0, 1e-9);
    EXPECT_TRUE(std::isnan(flicker(before, after, flowOf(100, 0), kBorder)));
}

}  // namespace
}  // namespace mfar::eval
