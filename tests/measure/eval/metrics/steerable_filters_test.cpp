#include "tests/measure/eval/metrics/steerable_filters.h"

#include <gtest/gtest.h>

namespace mfar::eval {
namespace {

TEST(SteerableFilters, FiltersHaveTheSumsThatAPyramidNeeds) {
    const SteerableFilters filters = steerableFilters();
    EXPECT_NEAR(cv::sum(filters.highPass)[0], 0, 1e-5);
    EXPECT_NEAR(cv::sum(filters.firstLowPass)[0], 1, 1e-5);
    EXPECT_NEAR(cv::sum(filters.lowPass)[0], 2, 1e-5);
    for (const cv::Mat& taps : filters.orientation)
        EXPECT_NEAR(cv::sum(taps)[0], 0, 1e-12);
}

double correlatedAt(const cv::Mat& picture, const cv::Mat& taps, int y, int x) {
    double sum = 0;
    for (int j = 0; j < taps.rows; ++j)
        for (int i = 0; i < taps.cols; ++i) {
            const auto mirrored = [](int k, int n) {
                k = std::abs(k) % (2 * n - 2);
                return k < n ? k : 2 * n - 2 - k;
            };
            sum += taps.at<double>(j, i) *
                   picture.at<double>(mirrored(y + j - taps.rows / 2, picture.rows),
                                      mirrored(x + i - taps.cols / 2, picture.cols));
        }
    return sum;
}

TEST(Correlate, MatchesTheSumOverAMirroredPicture) {
    const SteerableFilters filters = steerableFilters();
    for (const cv::Size size : {cv::Size(17, 9), cv::Size(30, 23), cv::Size(7, 40)}) {
        cv::Mat picture(size, CV_64F);
        cv::RNG(5).fill(picture, cv::RNG::UNIFORM, 0, 1);
        for (const int step : {1, 2})
            for (const cv::Mat& taps : {filters.lowPass, filters.orientation[1]}) {
                const cv::Mat got = correlate(picture, taps, step);
                ASSERT_EQ(got.size(), cv::Size((size.width + step - 1) / step,
                                               (size.height + step - 1) / step));
                for (int y = 0; y < got.rows; ++y)
                    for (int x = 0; x < got.cols; ++x)
                        ASSERT_NEAR(got.at<double>(y, x),
                                    correlatedAt(picture, taps, y * step, x * step), 1e-12);
            }
    }
}

}  // namespace
}  // namespace mfar::eval
