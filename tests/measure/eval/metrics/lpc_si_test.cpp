#include "tests/measure/eval/metrics/lpc_si.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <limits>
#include <stdexcept>

namespace mfar::eval {
namespace {

cv::Mat shapes(cv::Size size) {
    cv::Mat out(size, CV_64F, cv::Scalar(120));
    cv::RNG random(3);
    for (int i = 0; i < size.area() / 400; ++i)
        cv::circle(out, {random.uniform(0, size.width), random.uniform(0, size.height)},
                   random.uniform(4, 24), cv::Scalar(random.uniform(20, 240)), cv::FILLED);
    return out;
}

cv::Mat softened(const cv::Mat& picture, double sigma) {
    cv::Mat out;
    cv::GaussianBlur(picture, out, {0, 0}, sigma, sigma, cv::BORDER_REFLECT_101);
    return out;
}

TEST(LpcSi, IndexFallsWithBlurForBothFilterRatios) {
    cv::Mat edge(80, 96, CV_64F, cv::Scalar(50));
    edge.colRange(41, 96) = 200;
    for (const double ratio : {kLpcRelease, kLpcVariant}) {
        const double a = lpcSi(edge, ratio), b = lpcSi(softened(edge, 1), ratio);
        const double c = lpcSi(softened(edge, 2), ratio);
        EXPECT_GT(a, b);
        EXPECT_GT(b, c);
        EXPECT_LT(a, 1);
    }
}

TEST(LpcSi, ConstantPicturesAreNotSharp) {
    EXPECT_NEAR(lpcSi(cv::Mat(40, 50, CV_64F, cv::Scalar(128))), 0, 1e-9);
}

TEST(LpcTiles, OneSharpPatchDoesNotRaiseTheMedianOfTheTiles) {
    const cv::Mat sharp = shapes({320, 256});
    cv::Mat patched = softened(sharp, 3);
    const double soft = lpcSi(patched);
    const cv::Rect patch(130, 100, 40, 40);
    sharp(patch).copyTo(patched(patch));
    EXPECT_GT(lpcSi(patched), soft + 0.3);
    const LpcTiles tiles = lpcTiles(patched);
    EXPECT_NEAR(tiles.median, lpcTiles(softened(sharp, 3)).median, 0.03);
    EXPECT_LE(tiles.p10, tiles.median);
    EXPECT_LE(tiles.median, tiles.p90);
}

TEST(LpcSi, InvalidPicturesAreRefused) {
    const cv::Mat picture = shapes({40, 40});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)lpcSi(shapes({40, 31})), std::invalid_argument);
    EXPECT_THROW((void)lpcSi(picture * nan), std::invalid_argument);
    EXPECT_THROW((void)lpcSi(picture, 1), std::invalid_argument);
    EXPECT_THROW((void)lpcTiles(shapes({256, 255})), std::invalid_argument);
}

}  // namespace
}  // namespace mfar::eval
