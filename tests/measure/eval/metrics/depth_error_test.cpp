#include "tests/measure/eval/metrics/depth_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mfar::eval {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

cv::Mat everywhere(const cv::Mat& like) {
    return {like.size(), CV_8U, cv::Scalar(255)};
}

TEST(DepthError, MeasuresErrorAndSharesOfWrongAndOfKnownPixels) {
    const cv::Mat truth = (cv::Mat_<float>(1, 6) << 0.5F, 0.5F, 0.5F, 0.5F, kNan, 0);
    const cv::Mat inverseDepth = (cv::Mat_<float>(1, 6) << 0.5F, 0.4F, 0.48F, 0, 1, 1);
    const DepthError error = depthError(inverseDepth, truth, 20, everywhere(truth));
    EXPECT_EQ(error.pixels, 4U);
    EXPECT_NEAR(error.absrel, 0.5 / 0.48 - 1, 1e-6);  // median of the errors 0, 1/24 and 1/4
    EXPECT_DOUBLE_EQ(error.bad1, 0.5);  // one pixel is wrong by 2 px, one has no depth
    EXPECT_DOUBLE_EQ(error.completeness, 0.75);
}

TEST(DepthError, DeltaCountsTooLargeAndTooSmallDepths) {
    const cv::Mat truth(1, 5, CV_32F, cv::Scalar(1));
    const cv::Mat inverseDepth = (cv::Mat_<float>(1, 5) << 1.2F, 1 / 1.3F, 1.9F, 2, 0);
    const DepthError error = depthError(inverseDepth, truth, 10, everywhere(truth));
    EXPECT_DOUBLE_EQ(error.delta[0], 0.2);
    EXPECT_DOUBLE_EQ(error.delta[1], 0.4);
    EXPECT_DOUBLE_EQ(error.delta[2], 0.6);  // 1.25^3 = 1.95
}

TEST(DepthSparsification, OrdersPixelsWithKnownDepthByVariance) {
    const cv::Mat truth = (cv::Mat_<float>(1, 5) << 1, 1, 1, 1, kNan);
    const cv::Mat inverseDepth = (cv::Mat_<float>(1, 5) << 1.1F, 1.2F, 1.4F, 0, 9);
    const cv::Mat variance = (cv::Mat_<float>(1, 5) << 0.1F, 0.2F, 0.3F, kNan, kNan);
    EXPECT_NEAR(depthSparsification(inverseDepth, variance, truth, 10).ause, 0, 1e-9);
    EXPECT_GT(depthSparsification(inverseDepth, 1 - variance, truth, 10).ausePerRandom, 1);
}

TEST(DepthError, CountsOnlyPixelsInTheMask) {
    const cv::Mat truth(2, 2, CV_32F, cv::Scalar(1));
    const cv::Mat inverseDepth = (cv::Mat_<float>(2, 2) << 1, 2, 2, 2);
    cv::Mat mask = everywhere(truth) & 0;
    EXPECT_EQ(depthError(inverseDepth, truth, 10, mask).pixels, 0U);
    EXPECT_TRUE(std::isnan(depthError(inverseDepth, truth, 10, mask).absrel));
    mask.at<uchar>(0, 0) = 255;
    EXPECT_EQ(depthError(inverseDepth, truth, 10, mask).bad1, 0);
}

TEST(DepthError, ValuesNotAboveZeroAreUnknown) {
    const cv::Mat truth(1, 4, CV_32F, cv::Scalar(1));
    const cv::Mat inverseDepth = (cv::Mat_<float>(1, 4) << kNan, -1, 0, INFINITY);
    const DepthError error = depthError(inverseDepth, truth, 10, everywhere(truth));
    EXPECT_EQ(error.completeness, 0);
    EXPECT_EQ(error.bad1, 1);
    EXPECT_TRUE(std::isnan(error.absrel));
}

TEST(DepthError, NearDepthEdgeMarksPixelsBesideJumpsOfTheDepth) {
    // A slope, then a step of the depth at column 20, then unknown depth from column 32 on.
    cv::Mat truth(9, 40, CV_32F);
    for (int y = 0; y < truth.rows; ++y)
        for (int x = 0; x < truth.cols; ++x)
            truth.at<float>(y, x) = x < 20 ? 1 + 0.02F * x : (x < 32 ? 3 : kNan);
    const cv::Mat edge = nearDepthEdge(truth, 4);
    for (int x = 0; x < truth.cols; ++x)
        EXPECT_EQ(edge.at<uchar>(4, x) != 0, x >= 15 && x <= 24) << x;
    EXPECT_EQ(cv::countNonZero(nearDepthEdge(cv::Mat::ones(5, 5, CV_32F), 4)), 0);
}

}  // namespace
}  // namespace mfar::eval
