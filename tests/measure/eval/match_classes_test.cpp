#include "tests/measure/eval/match_classes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar::eval {
namespace {

constexpr auto kOutside = static_cast<int>(MatchClass::Outside);
constexpr auto kUnmatched = static_cast<int>(MatchClass::Unmatched);
constexpr auto kMatched = static_cast<int>(MatchClass::Matched);

StereoRig finerStillRig() {
    StereoRig rig;
    rig.video = {{16, 12}, 15, 15, 7.5, 5.5, {}};
    rig.still = rig.video.scaledTo({48, 36});
    return rig;
}

StillMatch evenMatch(cv::Vec2f flow, float confidence) {
    return {cv::Mat(12, 16, CV_32FC2, cv::Scalar(flow[0], flow[1])),
            cv::Mat(12, 16, CV_32F, cv::Scalar(confidence))};
}

int count(const cv::Mat& classes, int of) {
    return cv::countNonZero(classes == of);
}

TEST(MatchClasses, ConfidenceDistinguishesMatchedFromUnmatchedPixels) {
    StillMatch match = evenMatch({0, 0}, kWellMatched);
    match.confidence.at<float>(2, 5) = 0.49F;
    match.confidence.at<float>(3, 5) = NAN;
    const cv::Mat classes = matchClasses(finerStillRig(), {48, 36}, match);
    EXPECT_EQ(count(classes, kUnmatched), 2 * 9);
    EXPECT_EQ(classes.at<unsigned char>(6, 15), kUnmatched);
    EXPECT_EQ(classes.at<unsigned char>(11, 17), kUnmatched);
    EXPECT_EQ(count(classes, kMatched), 48 * 36 - 2 * 9);
}

TEST(MatchClasses, PixelsWhoseFlowLeavesTheStillAreOutside) {
    const cv::Mat right = matchClasses(finerStillRig(), {48, 36}, evenMatch({4, 0}, 1));
    EXPECT_EQ(count(right, kOutside), 4 * 3 * 36);
    EXPECT_EQ(right.at<unsigned char>(0, 35), kMatched);
    EXPECT_EQ(right.at<unsigned char>(0, 36), kOutside);
    const cv::Mat up = matchClasses(finerStillRig(), {48, 36}, evenMatch({0, -2}, 0));
    EXPECT_EQ(count(up, kOutside), 2 * 3 * 48);
    EXPECT_EQ(count(up, kUnmatched), 10 * 3 * 48);
    EXPECT_EQ(count(matchClasses(finerStillRig(), {48, 36}, evenMatch({NAN, 0}, 1)), kOutside),
              48 * 36);
}

TEST(MatchClasses, PointsBehindTheStillsCameraAreOutside) {
    StereoRig rig = finerStillRig();
    rig.T_still_video.rotation = Eigen::AngleAxisd(CV_PI, Eigen::Vector3d::UnitY());
    EXPECT_EQ(count(matchClasses(rig, {48, 36}, evenMatch({0, 0}, 1)), kOutside), 48 * 36);
}

TEST(MatchClasses, EachClassHasItsShareAndGain) {
    cv::Mat classes(10, 10, CV_8U, cv::Scalar(kMatched));
    classes.rowRange(0, 3) = kOutside;
    const cv::Mat truth(10, 10, CV_64F, cv::Scalar(100)), bicubic = truth + 10;
    cv::Mat picture = truth + 1;
    picture.rowRange(0, 3) = 120;
    const auto values = matchClassValues(classes, picture, bicubic, truth);
    ASSERT_EQ(values.size(), matchClassColumns().size());
    EXPECT_DOUBLE_EQ(values[0].value(), 0.3);
    EXPECT_NEAR(values[1].value(), -20 * std::log10(2), 1e-9);
    EXPECT_EQ(values[2].value(), 0);
    EXPECT_FALSE(values[3]);
    EXPECT_DOUBLE_EQ(values[4].value(), 0.7);
    EXPECT_NEAR(values[5].value(), 20, 1e-9);
    EXPECT_FALSE(matchClassValues(classes, truth, bicubic, truth)[5])
        << "without errors, the gain must be empty";
}

}  // namespace
}  // namespace mfar::eval
