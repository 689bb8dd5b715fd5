#include "daemon/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace mfar {
namespace {

TEST(Histogram, QuantilesAreExactExceptForTheWidthOfABucket) {
    std::mt19937 random(1);
    std::lognormal_distribution<double> times(3, 1.5);
    std::vector<double> all(10001);
    Histogram histogram;
    for (double& ms : all)
        histogram.add(ms = times(random));
    std::sort(all.begin(), all.end());
    for (const double q : {0.01, 0.5, 0.9, 0.99}) {
        const double exact = all[static_cast<std::size_t>(q * 10000)];
        EXPECT_NEAR(histogram.quantile(q) / exact, 1, 0.025) << q;
    }
}

TEST(Histogram, WithASingleValueEveryQuantileIsThisValue) {
    Histogram histogram;
    histogram.add(20);
    for (const double q : {0.0, 0.5, 0.99, 1.0})
        EXPECT_NEAR(histogram.quantile(q), 20, 0.25) << q;
}

TEST(Histogram, QuantilesOfAnEmptyHistogramAreZero) {
    EXPECT_EQ(Histogram{}.quantile(0.5), 0);
}

TEST(Histogram, AcceptsEveryValueThatADeviceMayReport) {
    Histogram histogram;
    for (const double ms : {0.0, -1.0, 1e300, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()})
        histogram.add(ms);
    EXPECT_EQ(histogram.count(), 5U);
    EXPECT_TRUE(std::isfinite(histogram.quantile(0.5)));
    EXPECT_TRUE(std::isfinite(histogram.quantile(1)));
}

}  // namespace
}  // namespace mfar
