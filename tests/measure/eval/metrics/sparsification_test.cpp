#include "tests/measure/eval/metrics/sparsification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace mfar::eval {
namespace {

std::vector<float> ramp(std::size_t n) {
    std::vector<float> out(n);
    std::iota(out.begin(), out.end(), 1.0F);
    return out;
}

TEST(Sparsification, PerfectConfidenceGivesZeroArea) {
    const auto error = ramp(1000);
    std::vector<float> confidence;
    for (const float e : error)
        confidence.push_back(1 / e);
    const Sparsification got = sparsification(error, confidence);
    EXPECT_NEAR(got.ause, 0, 1e-12);
    EXPECT_DOUBLE_EQ(got.byConfidence.front(), 1);
    // Without the larger half of the errors 1 to n, their mean halves.
    EXPECT_NEAR(got.byConfidence[50], 501.0 / 1001, 1e-9);
}

TEST(Sparsification, EqualConfidencesGiveTheAreaOfARandomOrder) {
    const auto error = ramp(1000);
    const Sparsification got = sparsification(error, std::vector<float>(1000, 0.5F));
    for (const double left : got.byConfidence)
        EXPECT_NEAR(left, 1, 1e-12);
    EXPECT_NEAR(got.ausePerRandom, 1, 1e-12);
    EXPECT_NEAR(got.ause, 0.5, 0.01);  // area between 1 and a straight line from 1 to 0
}

TEST(Sparsification, ReversedConfidenceIsWorseThanRandomConfidence) {
    const auto error = ramp(100);
    EXPECT_GT(sparsification(error, error).ausePerRandom, 1.5);
}

TEST(Sparsification, WithoutErrorsTheAreaIsNan) {
    EXPECT_TRUE(std::isnan(sparsification({}, {}).ause));
    const std::vector<float> none(5, 0);
    EXPECT_TRUE(std::isnan(sparsification(none, ramp(5)).ause));
}

TEST(Sparsification, InvalidValuesAreRefused) {
    const std::vector<float> one{1}, two{1, 2}, less{-1};
    const std::vector<float> nan{std::numeric_limits<float>::quiet_NaN()};
    EXPECT_THROW((void)sparsification(one, two), std::invalid_argument);
    EXPECT_THROW((void)sparsification(less, one), std::invalid_argument);
    EXPECT_THROW((void)sparsification(one, nan), std::invalid_argument);
    EXPECT_THROW((void)sparsification(nan, one), std::invalid_argument);
}

}  // namespace
}  // namespace mfar::eval
