#include "tests/measure/eval/degrade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace mfar::eval {
namespace {

TEST(Degrade, ReadsAnySubsetOfGainGammaBlurAndNoise) {
    EXPECT_EQ(parseDegradation(""), Degradation{});
    EXPECT_EQ(parseDegradation("gamma=1.3,gain=0.7"), (Degradation{0.7, 1.3, 0, 0}));
    EXPECT_EQ(parseDegradation("gain=0.7,gamma=1.3,blur=0.7,noise=4"),
              (Degradation{0.7, 1.3, 0.7, 4}));
}

TEST(Degrade, InvalidDegradationsAreRefused) {
    for (const char* text : {"gian=1", "gain", "gain=", "gain=0", "gain=-1", "blur=-1", "noise=x",
                             "gamma=1.3x", "gain=nan", ",gain=1"})
        EXPECT_THROW((void)parseDegradation(text), std::invalid_argument) << text;
}

TEST(Degrade, NoDegradationIsIdentity) {
    cv::Mat picture(20, 30, CV_8UC3);
    cv::RNG(3).fill(picture, cv::RNG::UNIFORM, 0, 256);
    EXPECT_EQ(cv::norm(degrade(picture, {}, 1), picture, cv::NORM_INF), 0);
}

TEST(Degrade, GainComesBeforeGamma) {
    const cv::Mat picture(2, 2, CV_8UC3, cv::Scalar::all(200));
    const cv::Mat out = degrade(picture, {0.7, 1.3, 0, 0}, 1);
    EXPECT_NEAR(out.at<cv::Vec3b>(0, 0)[1], 255 * std::pow(0.7 * 200 / 255, 1.3), 0.51);
}

TEST(Degrade, BlurKeepsTheMeanAndSpreadsAPoint) {
    cv::Mat picture(41, 41, CV_8UC1, cv::Scalar(0));
    picture.at<std::uint8_t>(20, 20) = 255;
    const cv::Mat out = degrade(picture, {1, 1, 1.0, 0}, 1);
    EXPECT_NEAR(out.at<std::uint8_t>(20, 20), 255 / (2 * CV_PI), 2);
    EXPECT_NEAR(cv::sum(out)[0], 255, 8);
}

TEST(Degrade, NoiseHasTheRequestedSigmaAndDependsOnTheSeed) {
    const cv::Mat picture(200, 200, CV_8UC3, cv::Scalar::all(128));
    const cv::Mat first = degrade(picture, {1, 1, 0, 4}, 5);
    EXPECT_EQ(cv::norm(first, degrade(picture, {1, 1, 0, 4}, 5), cv::NORM_INF), 0);
    EXPECT_GT(cv::norm(first, degrade(picture, {1, 1, 0, 4}, 6), cv::NORM_INF), 0);
    cv::Scalar mean, sigma;
    cv::meanStdDev(first, mean, sigma);
    EXPECT_NEAR(mean[0], 128, 0.2);
    EXPECT_NEAR(sigma[1], 4, 0.1);
}

}  // namespace
}  // namespace mfar::eval
