#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/guidance_learner.h"
#include "tests/learn/sensor_pair.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace mfar::enlarge {
namespace {

/// Two matches of the same noisy video, from which guidance is learned. In `truth`, the video is
/// matched with a new still without noise. In `older`, it is matched with an older, noisy still.
struct Stills {
    Stills(double videoNoise, double olderNoise, unsigned seed, SensorPair how = {}) {
        const twin::Grey sharp = sharpDiscs(seed);
        how.videoNoise = videoNoise;
        how.seed = seed;
        truth = matchedPictures(sharp, how);
        how.stillNoise = olderNoise;
        older = matchedPictures(sharp, how);
    }
    MatchedPictures truth, older;
};

GuidanceLearner learned(double videoNoise, double olderNoise, unsigned stills = 3) {
    GuidanceLearner out;
    for (unsigned i = 1; i <= stills; ++i) {
        const Stills of(videoNoise, olderNoise, i);
        EXPECT_TRUE(out.add(TrustedPairs(of.truth), of.older, FilterBank::prior()));
    }
    return out;
}

TEST(GuidanceLearner, GuidanceIsZeroBeforeTheFirstStill) {
    EXPECT_FALSE(GuidanceLearner().guidance().any());
    EXPECT_FALSE(FilterBank::prior().guidance().any());
    EXPECT_EQ(GuidanceLearner().gainDb(), 0);
}

TEST(GuidanceLearner, FindsTheBestWeightsForNoisyVideoAndStill) {
    // A video pixel is the mean of 4x4 still pixels, so the variance of their noise is divided
    // by 16.
    for (const auto& [video, still] : {std::pair{4.0, 0.0}, {4.0, 8.0}, {4.0, 16.0}}) {
        const double best = video * video / (video * video + still * still / 16);
        const GuidanceLearner learner = learned(video, still);
        EXPECT_NEAR(learner.guidance().still, best, 0.12) << video << " " << still;
        EXPECT_NEAR(learner.guidance().video, best, 0.12) << video << " " << still;
        EXPECT_GT(learner.gainDb(), 0.02);
        EXPECT_EQ(learner.pairs(), 3U);
    }
}

TEST(GuidanceLearner, LearnedFactorsFitTheExposureOfTheStill) {
    // `weight` converts the still's detail to the video's exposure.
    for (const double gain : {0.5, 0.8}) {
        GuidanceLearner learner;
        for (unsigned i = 1; i <= 3; ++i) {
            const Stills of(4, 0, i, {.gain = gain, .weight = 1 / gain});
            EXPECT_TRUE(learner.add(TrustedPairs(of.truth), of.older, FilterBank::prior()));
        }
        EXPECT_NEAR(learner.guidance().still, 1, 0.12) << gain;
        EXPECT_NEAR(learner.guidance().video, gain, 0.12) << gain;
    }
}

TEST(GuidanceLearner, FindsWhetherAVideoPixelAveragesGreyLevelsOrLight) {
    for (const bool averagesLight : {false, true}) {
        GuidanceLearner learner;
        for (unsigned i = 1; i <= 3; ++i) {
            const Stills of(2, 0, i, {.averagesLight = averagesLight});
            EXPECT_TRUE(learner.add(TrustedPairs(of.truth), of.older, FilterBank::prior()));
        }
        EXPECT_NEAR(learner.guidance().light, averagesLight ? 1 : 0, 0.15);
        EXPECT_GT(learner.guidance().still, 0.8);
    }
}

TEST(GuidanceLearner, AStillMuchNoisierThanTheVideoGivesNoGuidance) {
    EXPECT_FALSE(learned(0, 16).guidance().any());
    EXPECT_FALSE(learned(1, 24).guidance().any())
        << "the gain would be smaller than the possible loss";
}

TEST(GuidanceLearner, GuidanceIsNoLongerUsedWhenItStopsHelping) {
    GuidanceLearner learner = learned(4, 0);
    ASSERT_GT(learner.guidance().still, 0.8);
    for (unsigned i = 10; i < 13 || (i < 60 && learner.guidance().any()); ++i) {
        const Stills of(0, 16, i);
        learner.add(TrustedPairs(of.truth), of.older, FilterBank::prior());
    }
    EXPECT_FALSE(learner.guidance().any());
}

TEST(GuidanceLearner, UnusablePicturesAreIgnored) {
    GuidanceLearner learner = learned(4, 8, 1);
    const auto before = learner.stored();
    const auto ignores = [&](const Stills& of) {
        return !learner.add(TrustedPairs(of.truth), of.older, FilterBank::prior()) &&
               learner.stored() == before;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (float LookUpCell::* part : {&LookUpCell::x, &LookUpCell::y, &LookUpCell::weight}) {
        Stills of(4, 8, 2);
        for (int y = 0; y < of.older.lookUps.size().height; ++y)
            for (int x = 0; x < of.older.lookUps.size().width; ++x)
                of.older.lookUps[y][x].*part = nan;
        EXPECT_TRUE(ignores(of)) << "NaN look-ups must be ignored";
    }
    EXPECT_TRUE(ignores(Stills(4, 8, 2, {.weight = 0})))
        << "a still without weight must be ignored";
    Stills bright(4, 8, 2);
    for (int y = 0; y < bright.older.luma.size().height; ++y)
        std::fill_n(bright.older.luma[y], bright.older.luma.size().width, 255 * kLumaScale);
    EXPECT_TRUE(ignores(bright)) << "a saturated picture must be ignored";
    Stills small(4, 8, 2);
    small.older = matchedPictures(sharpDiscs(2, {128, 96}), {});
    EXPECT_TRUE(ignores(small)) << "pictures of another size must be ignored";
    std::stop_source stop;
    stop.request_stop();
    const Stills good(4, 8, 2);
    EXPECT_FALSE(
        learner.add(TrustedPairs(good.truth), good.older, FilterBank::prior(), stop.get_token()));
    EXPECT_EQ(learner.stored(), before);
}

TEST(GuidanceLearner, AFewCellsWithInfinitePositionsHaveLittleInfluence) {
    GuidanceLearner learner;
    for (unsigned i = 1; i <= 3; ++i) {
        Stills of(4, 8, i);
        for (int y = 0; y < of.older.lookUps.size().height; y += 5)
            of.older.lookUps[y][7].x = std::numeric_limits<float>::infinity();
        EXPECT_TRUE(learner.add(TrustedPairs(of.truth), of.older, FilterBank::prior()));
    }
    EXPECT_NEAR(learner.guidance().still, learned(4, 8).guidance().still, 0.03);
}

TEST(GuidanceLearner, StillsOfAnotherSceneAreIgnored) {
    GuidanceLearner learner;
    for (unsigned i = 1; i <= 3; ++i) {
        Stills of(4, 0, i);
        of.older.still = matchedPictures(sharpDiscs(i + 50), {}).still;
        learner.add(TrustedPairs(of.truth), of.older, FilterBank::prior());
    }
    EXPECT_LT(learner.guidance().still, 0.05);
}

TEST(GuidanceLearner, StoredNumbersOutOfRangeAreRefused) {
    const auto good = learned(4, 8, 1).stored();
    GuidanceLearner learner;
    EXPECT_TRUE(learner.restore(good));
    EXPECT_EQ(learner.stored(), good);
    for (const auto& [at, value] : {std::pair{0, -1.0},
                                    {0, 1e18},
                                    {1, 1.5},
                                    {1, -0.1},
                                    {2, 2.5},
                                    {2, -0.1},
                                    {3, -1.0},
                                    {5, -1.0},
                                    {9, -1.0},
                                    {10, -1.0},
                                    {16, -1.0},
                                    {17, 2.5},
                                    {17, -0.1},
                                    {18, -1.0},
                                    {27, -1.0}}) {
        auto bad = good;
        bad[static_cast<std::size_t>(at)] = value;
        EXPECT_FALSE(learner.restore(bad)) << at;
        EXPECT_EQ(learner.stored(), good);
    }
}

TEST(EnlargerLearner, GuidanceIsLearnedAndKeptWithTheFilters) {
    EnlargerLearner learner;
    Stills of(4, 8, 1);
    EXPECT_EQ(learner.addOlder(of.truth, of.older), EnlargerLearner::Outcome::Replaced);
    EXPECT_GT(learner.filters()->guidance().still, 0.5);
    EXPECT_EQ(learner.counts().pairs, 1U);
    EXPECT_EQ(learner.counts().guidance, learner.filters()->guidance());
    EXPECT_GT(learner.counts().guidanceGainDb, 0);
    learner.add(of.truth);
    EXPECT_GT(learner.filters()->guidance().still, 0.5) << "new filters must keep the guidance";
    EXPECT_EQ(learner.addOlder(matchedPictures(sharpDiscs(1), sharpDiscs(2), {}), of.older),
              EnlargerLearner::Outcome::Refused);
}

}  // namespace
}  // namespace mfar::enlarge
