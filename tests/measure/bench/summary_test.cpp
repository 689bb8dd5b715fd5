#include "tests/measure/bench/summary.h"

#include <gtest/gtest.h>

#include <numeric>

namespace mfar::bench {
namespace {

TEST(Summary, MedianIsTheMiddleValueOrTheMeanOfBothMiddleValues) {
    EXPECT_DOUBLE_EQ(summarise({3, 1, 2}).median, 2);
    EXPECT_DOUBLE_EQ(summarise({4, 1, 2, 3}).median, 2.5);
    EXPECT_DOUBLE_EQ(summarise({4, 1, 2, 3}).min, 1);
}

TEST(Summary, NinetyNinePercentOfTheTimesDoNotExceedP99) {
    std::vector<double> values(200);
    std::iota(values.begin(), values.end(), 1);
    EXPECT_DOUBLE_EQ(summarise(values).p99, 198);
    EXPECT_DOUBLE_EQ(summarise({7}).p99, 7);
}

TEST(Summary, WithoutMeasurementsTheNumberOfRunsIsZero) {
    EXPECT_EQ(summarise({}).runs, 0U);
}

}  // namespace
}  // namespace mfar::bench
