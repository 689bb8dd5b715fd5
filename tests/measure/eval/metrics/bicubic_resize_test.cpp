#include "tests/measure/eval/metrics/bicubic_resize.h"

#include <gtest/gtest.h>

namespace mfar::eval {
namespace {

TEST(BicubicResize, KeepsConstantsAndSlopes) {
    cv::Mat slope(20, 30, CV_64F);
    for (int y = 0; y < slope.rows; ++y)
        for (int x = 0; x < slope.cols; ++x)
            slope.at<double>(y, x) = 2 * x - 3 * y;
    const cv::Mat half = bicubicResize(slope, {15, 10});
    EXPECT_NEAR(half.at<double>(5, 7), 2 * 14.5 - 3 * 10.5, 1e-9);
    const cv::Mat twice = bicubicResize(slope, {60, 40});
    EXPECT_NEAR(twice.at<double>(20, 30), 2 * 14.75 - 3 * 9.75, 1e-9);
    const cv::Mat level = bicubicResize(cv::Mat(7, 5, CV_64F, cv::Scalar(4)), {3, 11});
    EXPECT_EQ(level.size(), cv::Size(3, 11));
    EXPECT_LT(cv::norm(level, cv::Mat(11, 3, CV_64F, cv::Scalar(4)), cv::NORM_INF), 1e-12);
}

TEST(BicubicResize, SameSizeIsIdentity) {
    cv::Mat noise(9, 8, CV_64F);
    cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 1);
    EXPECT_EQ(cv::norm(bicubicResize(noise, noise.size()), noise, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace mfar::eval
