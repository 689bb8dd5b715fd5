#include "tests/measure/train/enlarger_training.h"

#include <gtest/gtest.h>

#include <random>

namespace mfar::train {
namespace {

twin::Grey discs(unsigned seed) {
    std::mt19937 random(seed);
    twin::Grey out = twin::greyOf({320, 256}, [](int, int) { return 120.0; });
    for (int i = 0; i < 150; ++i) {
        const int cx = int(random() % 320), cy = int(random() % 256), r = 4 + int(random() % 26);
        const double level = 20 + double(random() % 216);
        for (int y = std::max(cy - r, 0); y < std::min(cy + r, 256); ++y)
            for (int x = std::max(cx - r, 0); x < std::min(cx + r, 320); ++x)
                if ((x - cx) * (x - cx) + (y - cy) * (y - cy) < r * r)
                    out.values[std::size_t(y) * 320 + x] = level;
    }
    return out;
}

EnlargerTraining::Outcome learnedFrom(int pictures, double noise) {
    EnlargerTraining training;
    for (int i = 0; i < pictures; ++i)
        training.add({discs(i + 1), {noise, 0, unsigned(i)}}, i % 2 == 1);
    return training.solve(20);
}

TEST(EnlargerTraining, FiltersLearnedFromDiscsBeatCubicEnlarging) {
    const auto outcome = learnedFrom(16, 0);
    EXPECT_EQ(outcome.filters.size(), std::size_t{enlarge::kUnique});
    EXPECT_GT(outcome.used, 20);
    for (const int by : {0, 1})
        EXPECT_LT(outcome.error[by], 0.85 * outcome.cubicError[by]);
}

TEST(EnlargerTraining, TheSamePicturesGiveTheSameFilters) {
    EXPECT_EQ(learnedFrom(2, 1).filters, learnedFrom(2, 1).filters);
    EXPECT_NE(learnedFrom(2, 1).filters, learnedFrom(2, 0).filters);
}

TEST(EnlargerTraining, FiltersAreNearZeroIfCubicEnlargingIsExact) {
    EnlargerTraining training;
    const twin::Grey slope =
        twin::greyOf({256, 256}, [](int x, int y) { return 20 + 0.5625 * x + 0.28125 * y; });
    for (const bool heldOut : {false, true})
        training.add({slope, {}}, heldOut);
    const auto outcome = training.solve(20);
    for (const FilterBank::Filter& filter : outcome.filters)
        for (const std::int16_t weight : filter)
            ASSERT_LE(std::abs(weight), 820) << "a weight is larger than a tenth";
}

TEST(EnlargerTraining, ClassesWithoutHeldOutPixelsGetNoFilter) {
    EnlargerTraining training;
    for (int i = 0; i < 2; ++i)
        training.add({discs(i + 1), {}}, false);
    EXPECT_EQ(training.solve(20).used, 0);
}

TEST(EnlargerTraining, FiltersThatMakeHeldOutPicturesWorseAreDropped) {
    // The filters are learned without noise and checked on pure noise, which sharpening only
    // amplifies.
    EnlargerTraining training;
    training.add({discs(1), {}}, false);
    training.add({twin::greyOf({320, 256}, [](int, int) { return 128.0; }), {12, 0, 5}}, true);
    const auto outcome = training.solve(20);
    for (const int by : {0, 1})
        EXPECT_LE(outcome.error[by], outcome.cubicError[by]);
}

TEST(TrainingPair, VideoIsAreaAveragedAndTheTargetIsTheCubicsError) {
    const twin::Grey sharp =
        twin::greyOf({128, 96}, [](int x, int y) { return x < 64 && y < 48 ? 200.0 : 40.0; });
    const TrainingPair pair(sharp, {});
    EXPECT_EQ(pair.size(), (Size{36, 27}));
    EXPECT_EQ(pair.row(3)[5], 1600);
    EXPECT_EQ(pair.row(20)[30], 320);
    EXPECT_EQ(pair.row(3)[-7], pair.row(3)[0]);
    EXPECT_EQ(pair.row(-2), pair.row(0));
    EXPECT_NEAR(pair.target(8, 8), 0, 1e-9);
    double most = 0;
    for (int x = 64; x < 80; ++x)
        most = std::max(most, std::abs(pair.target(x, 8)));
    EXPECT_GT(most, 10) << "the target lacks the cubic's error at the edge";
}

}  // namespace
}  // namespace mfar::train
