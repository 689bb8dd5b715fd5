#include "tests/measure/eval/metrics/hdrvdp.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <limits>
#include <stdexcept>

namespace mfar::eval {
namespace {

cv::Mat smoothNoise(cv::Size size, int channels = 1) {
    cv::Mat out(size, CV_64FC(channels));
    cv::RNG(7).fill(out, cv::RNG::UNIFORM, 0, 255);
    cv::GaussianBlur(out, out, {0, 0}, 1);
    return out;
}

double q(const cv::Mat& test, const cv::Mat& reference, const HdrVdpDisplay& display = {}) {
    return hdrVdp(displayedLight(test, display), displayedLight(reference, display),
                  display.pixelsPerDegree)
        .q;
}

TEST(DisplayedLight, LightRangesFromBlackToWhite) {
    const cv::Mat grey = (cv::Mat_<double>(1, 3) << 0, 127.5, 255);
    const cv::Mat light = displayedLight(grey, {.peak = 200, .black = 2});
    EXPECT_DOUBLE_EQ(light.at<double>(0), 2);
    EXPECT_NEAR(light.at<double>(1), 2 + 198 * std::pow(0.5, 2.2), 1e-12);
    EXPECT_DOUBLE_EQ(light.at<double>(2), 200);
    const cv::Mat colour(1, 1, CV_64FC3, cv::Scalar(0, 0.02 * 255, 255));
    const auto shown = displayedLight(colour, {}).at<cv::Vec3d>(0);
    EXPECT_DOUBLE_EQ(shown[0], 1);
    EXPECT_NEAR(shown[1], 1 + 99 * 0.02 / 12.92, 1e-12);
    EXPECT_DOUBLE_EQ(shown[2], 100);
}

TEST(DisplayedLight, ImpossibleValuesAreRefused) {
    const cv::Mat grey(2, 2, CV_64F, cv::Scalar(7)), wrong(2, 2, CV_64F, cv::Scalar(256));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)displayedLight(wrong, {}), std::invalid_argument);
    EXPECT_THROW((void)displayedLight(cv::Mat(2, 2, CV_64F, cv::Scalar(nan)), {}),
                 std::invalid_argument);
    EXPECT_THROW((void)displayedLight(cv::Mat(2, 2, CV_8U, cv::Scalar(7)), {}),
                 std::invalid_argument);
    EXPECT_THROW((void)displayedLight(grey, {.peak = 1, .black = 2}), std::invalid_argument);
    EXPECT_THROW((void)displayedLight(grey, {.black = 0}), std::invalid_argument);
    EXPECT_THROW((void)displayedLight(grey, {.gamma = nan}), std::invalid_argument);
}

TEST(HdrVdp, EqualPicturesScoreAHundred) {
    const cv::Mat grey = smoothNoise({50, 41}), colour = smoothNoise({33, 20}, 3);
    EXPECT_EQ(q(grey, grey), 100);
    EXPECT_EQ(q(colour, colour), 100);
}

TEST(HdrVdp, ScoreFallsAsNoiseRises) {
    const cv::Mat clean = smoothNoise({64, 48});
    cv::Mat noise(clean.size(), CV_64F);
    cv::RNG(3).fill(noise, cv::RNG::UNIFORM, -1, 1);
    double last = 100;
    for (const double amplitude : {2, 8, 32}) {
        cv::Mat noisy = cv::min(cv::max(clean + amplitude * noise, 0), 255);
        const double now = q(noisy, clean);
        EXPECT_LT(now, last - 1) << amplitude;
        last = now;
    }
}

TEST(HdrVdp, DifferencesBelowAThousandthAreInvisible) {
    const cv::Mat light(40, 40, CV_64F, cv::Scalar(50));
    EXPECT_EQ(hdrVdp(light * 1.0009, light, 30).q, 100);
    EXPECT_LT(hdrVdp(light * 1.1, light, 30).q, 99);
}

TEST(HdrVdp, ResultDoesNotDependOnTheNumberOfThreads) {
    const cv::Mat a = smoothNoise({64, 48}), b = cv::Mat(255 - a);
    const double together = q(a, b);
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    EXPECT_EQ(q(a, b), together);
    cv::setNumThreads(threads);
}

TEST(HdrVdp, InvalidPicturesAreRefused) {
    const cv::Mat light(20, 20, CV_64F, cv::Scalar(50)), small(16, 20, CV_64F, cv::Scalar(50));
    const cv::Mat dark(20, 20, CV_64F, cv::Scalar(0)),
        colour(20, 20, CV_64FC3, cv::Scalar(1, 1, 1));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)hdrVdp(small, small, 30), std::invalid_argument);
    EXPECT_THROW((void)hdrVdp(light, small, 30), std::invalid_argument);
    EXPECT_THROW((void)hdrVdp(light, colour, 30), std::invalid_argument);
    EXPECT_THROW((void)hdrVdp(dark, light, 30), std::invalid_argument);
    EXPECT_THROW((void)hdrVdp(light, light * nan, 30), std::invalid_argument);
    EXPECT_THROW((void)hdrVdp(light, light, 0), std::invalid_argument);
    EXPECT_THROW((void)hdrVdp(light, light, nan), std::invalid_argument);
}

}  // namespace
}  // namespace mfar::eval
