#include "tests/measure/eval/metrics/occlusion_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar::eval {
namespace {

const cv::Size kSize(40, 30);

cv::Mat rectangle(const cv::Rect& where) {
    cv::Mat out(kSize, CV_8U, cv::Scalar(0));
    out(where).setTo(255);
    return out;
}

TEST(OcclusionScore, EqualMasksHaveFullOverlapAndZeroBoundaryError) {
    const cv::Mat mask = rectangle({5, 6, 10, 8});
    const OcclusionScore score = occlusionScore(mask, mask);
    EXPECT_EQ(score.overlap, 1);
    EXPECT_EQ(score.boundary, 0);
}

TEST(OcclusionScore, AnObjectShiftedByTwoPixelsHasLessOverlapAndABoundaryError) {
    const OcclusionScore score = occlusionScore(rectangle({7, 6, 10, 8}), rectangle({5, 6, 10, 8}));
    EXPECT_DOUBLE_EQ(score.overlap, 8.0 / 12);
    // Mean over boundary pixels. Right side: 8 pixels are off by 2 px, and 2 pixels by 1 px. Left
    // side: distances to the nearest side of the true boundary.
    const double right = 8 * 2 + 2 * 1, left = 0 + 1 + 2 + 2 + 2 + 2 + 1 + 0;
    EXPECT_NEAR(score.boundary, (right + left) / 32, 1e-6);
}

TEST(OcclusionScore, AnEmptyMaskHasNoOverlapAndAnUnknownBoundaryError) {
    const cv::Mat none(kSize, CV_8U, cv::Scalar(0)), some = rectangle({5, 6, 10, 8});
    EXPECT_TRUE(std::isnan(occlusionScore(none, none).overlap));
    EXPECT_EQ(occlusionScore(none, some).overlap, 0);
    EXPECT_EQ(occlusionScore(some, none).overlap, 0);
    EXPECT_TRUE(std::isnan(occlusionScore(none, some).boundary));
    EXPECT_TRUE(std::isnan(occlusionScore(some, none).boundary));
}

TEST(OcclusionScore, FlickerCountsPixelsThatAppearOrDisappear) {
    cv::Mat before(kSize, CV_32F, cv::Scalar(0)), now;
    before(cv::Rect(0, 0, 20, 10)).setTo(1);
    now = before.clone();
    EXPECT_EQ(flicker(before, now, 200), 0);
    now(cv::Rect(0, 0, 4, 1)).setTo(0.51);  // smaller visible shares, but still above a half
    EXPECT_EQ(flicker(before, now, 200), 0);
    now(cv::Rect(0, 5, 3, 1)).setTo(0.49);
    now(cv::Rect(30, 20, 1, 1)).setTo(0.5);
    EXPECT_DOUBLE_EQ(flicker(before, now, 200), 0.02);
    EXPECT_TRUE(std::isnan(flicker(before, now, 0)));
}

}  // namespace
}  // namespace mfar::eval
