#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/fine_match_learner.h"
#include "tests/learn/sensor_pair.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar::enlarge {
namespace {

FineMatch learned(const SensorPair& pair, unsigned stills = 2) {
    FineMatchLearner out;
    for (unsigned seed = 1; seed <= stills; ++seed)
        EXPECT_TRUE(out.add(matchedPictures(sharpDiscs(seed), pair)));
    return out.fineMatch();
}

TEST(FineMatchLearner, FineMatchIsUnknownBeforeTheFirstStill) {
    EXPECT_FALSE(FineMatchLearner().fineMatch().isKnown());
    EXPECT_FALSE(FilterBank::prior().fineMatch().isKnown());
}

TEST(FineMatchLearner, FindsTheNoiseOfTheVideo) {
    EXPECT_LT(learned({}).noise, 0.5);
    for (const double noise : {2.0, 4.0}) {
        // The learner finds less than the noise's variance, because it uses the 10 % quantile of
        // the variances that the still leaves unexplained in the cells.
        const double fine = noise * noise;
        const float found = learned({.videoNoise = noise}).noise;
        EXPECT_GT(found, 0.4 * fine) << noise;
        EXPECT_LT(found, fine) << noise;
    }
}

TEST(FineMatchLearner, InaccurateMatchesRaiseTheUnpredictedShareOfDetail) {
    const float right = learned({.videoNoise = 1}).share,
                off = learned({.videoNoise = 1, .shift = 0.3}).share;
    EXPECT_GT(off, right + 0.02);
}

TEST(FineMatchLearner, WronglyMatchedPartOfThePictureHasLittleInfluence) {
    FineMatchLearner learner;
    MatchedPictures pictures = matchedPictures(sharpDiscs(1), {.videoNoise = 1});
    for (int y = 0; y < pictures.lookUps.size().height / 4; ++y)
        for (int x = 0; x < pictures.lookUps.size().width; ++x)
            pictures.lookUps[y][x].x += 20;
    ASSERT_TRUE(learner.add(pictures));
    const FineMatch right = learned({.videoNoise = 1}, 1);
    EXPECT_NEAR(learner.fineMatch().noise, right.noise, 0.3);
    EXPECT_NEAR(learner.fineMatch().share, right.share, 0.05);
}

TEST(FineMatchLearner, UnmatchedCellsAreIgnored) {
    FineMatchLearner learner;
    EXPECT_FALSE(learner.add(matchedPictures(sharpDiscs(1), {.weight = 0.1})));
    EXPECT_FALSE(learner.fineMatch().isKnown());
}

TEST(FineMatchLearner, StoredNumbersOutOfRangeAreRefused) {
    FineMatchLearner learner;
    ASSERT_TRUE(learner.add(matchedPictures(sharpDiscs(1), {.videoNoise = 2})));
    const auto good = learner.stored();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [at, value] : {std::pair{0, -1.0},
                                    {0, 1e9},
                                    {1, -1.0},
                                    {1, 1e9},
                                    {2, 1.5},
                                    {0, kNan},
                                    {1, kNan},
                                    {2, kNan}}) {
        auto bad = good;
        bad[static_cast<std::size_t>(at)] = value;
        EXPECT_FALSE(learner.restore(bad)) << at << " " << value;
        EXPECT_EQ(learner.stored(), good);
    }
    FineMatchLearner restored;
    EXPECT_TRUE(restored.restore(good));
    EXPECT_EQ(restored.fineMatch(), learner.fineMatch());
}

TEST(EnlargerLearner, FineMatchIsLearnedAndRestoredWithTheFilters) {
    EnlargerLearner learner;
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), {.videoNoise = 2})),
              EnlargerLearner::Outcome::Replaced);
    EXPECT_TRUE(learner.filters()->fineMatch().isKnown());
    EXPECT_EQ(learner.counts().fineMatch, learner.filters()->fineMatch());
    const auto restored = EnlargerLearner::restored(learner.stored("a"), "a", "state");
    EXPECT_EQ(restored.filters()->fineMatch(), learner.filters()->fineMatch());
}

}  // namespace
}  // namespace mfar::enlarge
