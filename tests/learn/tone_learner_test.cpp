#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/tone_sums.h"
#include "pipeline/enlarge/trusted_pairs.h"
#include "tests/learn/sensor_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar::enlarge {
namespace {

constexpr SensorPair kDarker{.gain = 0.7, .gamma = 1.3};

double shownBy(const SensorPair& pair, double level) {
    return 255 * pair.gain * std::pow(level / 255, pair.gamma);
}

void addStill(ToneLearner& learner, const SensorPair& pair) {
    learner.add(TrustedPairs(matchedPictures(sharpDiscs(1), pair)).toneSums(), {});
}

ToneLearner afterTwoStills(const SensorPair& pair) {
    ToneLearner out;
    for (int i = 0; i < 2; ++i)
        addStill(out, pair);
    return out;
}

/// Expects that the tone curve turns the still's levels into those of the scene.
void expectUndoes(const StillTone& tone, const SensorPair& pair) {
    for (double level = 60; level <= 210; level += 15)
        EXPECT_NEAR(tone.levels[std::size_t(std::lround(shownBy(pair, level)))], level, 5) << level;
}

/// Matched pictures whose still was already corrected with the tone curve `tone`.
MatchedPictures toned(const SensorPair& pair, const StillTone& tone) {
    MatchedPictures out = matchedPictures(sharpDiscs(1), pair);
    for (int y = 0; y < out.still.size().height; ++y)
        for (int x = 0; x < out.still.size().width; ++x)
            out.still[y][x] = tone.levels[out.still[y][x]];
    out.tone = tone;
    return out;
}

TEST(ToneLearner, EqualExposureGivesTheIdentityCurve) {
    EXPECT_TRUE(ToneLearner().tone().isIdentity());
    EXPECT_TRUE(FilterBank::prior().tone().isIdentity());
    EXPECT_TRUE(afterTwoStills({.videoNoise = 2}).tone().isIdentity());
}

TEST(ToneLearner, FindsTheCurveFromTheStillToTheVideo) {
    for (const SensorPair& pair : {kDarker, SensorPair{.gain = 1.0, .gamma = 0.8}})
        expectUndoes(afterTwoStills(pair).tone(), pair);
}

TEST(ToneSums, TheCurveNeverFalls) {
    ToneSums sums;
    for (const auto& [still, video] : {std::pair{40, 90}, {100, 60}, {200, 150}})
        sums.add(still, video, 1000);
    const StillTone tone = sums.tone();
    EXPECT_TRUE(std::ranges::is_sorted(tone.levels));
    EXPECT_FALSE(tone.isIdentity());
}

TEST(ToneLearner, StillsCorrectedWithTheLearnedCurveDoNotChangeIt) {
    ToneLearner learner = afterTwoStills(kDarker);
    const StillTone first = learner.tone();
    for (int i = 0; i < 4; ++i)
        learner.add(TrustedPairs(toned(kDarker, learner.tone())).toneSums(), learner.tone());
    EXPECT_EQ(learner.tone(), first);
}

TEST(ToneLearner, FollowsANewExposure) {
    ToneLearner learner = afterTwoStills(kDarker);
    for (int i = 0; i < 5; ++i)
        learner.add(TrustedPairs(toned({.gain = 0.9}, learner.tone())).toneSums(), learner.tone());
    expectUndoes(learner.tone(), {.gain = 0.9});
}

TEST(ToneLearner, ACurveIsUsedOnlyOnceASecondStillAgrees) {
    ToneLearner learner;
    addStill(learner, kDarker);
    EXPECT_TRUE(learner.tone().isIdentity());
    addStill(learner, kDarker);
    expectUndoes(learner.tone(), kDarker);
}

TEST(ToneLearner, AStillThatContradictsTheCurveEndsItsUse) {
    ToneLearner learner = afterTwoStills(kDarker);
    learner.add(TrustedPairs(toned({.gain = 0.9}, learner.tone())).toneSums(), learner.tone());
    EXPECT_TRUE(learner.tone().isIdentity());
}

TEST(ToneLearner, ExposuresThatDifferFromStillToStillGiveNoCurve) {
    ToneLearner learner;
    for (int i = 0; i < 6; ++i) {
        addStill(learner, i % 2 == 0 ? kDarker : SensorPair{.gain = 0.9});
        EXPECT_TRUE(learner.tone().isIdentity()) << i;
    }
}

TEST(ToneLearner, AnUnconfirmedCurveStaysUnusedAfterARestart) {
    ToneLearner learner, restored;
    addStill(learner, kDarker);
    ASSERT_TRUE(restored.restore(learner.stored()));
    EXPECT_TRUE(restored.tone().isIdentity());
    addStill(restored, kDarker);
    expectUndoes(restored.tone(), kDarker);
}

TEST(ToneLearner, StoredNumbersOutOfRangeAreRefused) {
    ToneLearner learner = afterTwoStills(kDarker);
    const auto good = learner.stored();
    const StillTone tone = learner.tone();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& [at, value] : {std::pair{0, -1.0},
                                    {0, 1e13},
                                    {1, 1e9},
                                    {2, 1e9},
                                    {0, kNan},
                                    {1, kNan},
                                    {2, kNan},
                                    {48, kNan},
                                    {48, 0.5},
                                    {48, 2.0}}) {
        auto bad = good;
        bad[static_cast<std::size_t>(at)] = value;
        EXPECT_FALSE(learner.restore(bad)) << at << " " << value;
        EXPECT_EQ(learner.stored(), good);
    }
    ToneLearner restored;
    EXPECT_TRUE(restored.restore(good));
    EXPECT_EQ(restored.tone(), tone);
}

TEST(EnlargerLearner, TheToneCurveIsLearnedWithTheFilters) {
    EnlargerLearner learner;
    for (const int scene : {1, 5})
        EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(scene), kDarker)),
                  EnlargerLearner::Outcome::Replaced);
    expectUndoes(learner.filters()->tone(), kDarker);
}

TEST(EnlargerLearner, GuidanceIsLearnedOnlyFromStillsWithThePresentToneCurve) {
    constexpr SensorPair kNoisy{.videoNoise = 4};
    MatchedPictures noisy = matchedPictures(sharpDiscs(5), kNoisy);
    EnlargerLearner learner;
    MatchedPictures older = matchedPictures(sharpDiscs(5), kNoisy);
    older.tone.levels.fill(90);
    EXPECT_EQ(learner.addOlder(noisy, older), EnlargerLearner::Outcome::Refused);
    EXPECT_EQ(learner.addOlder(noisy, noisy), EnlargerLearner::Outcome::Replaced);
    EXPECT_TRUE(learner.filters()->guidance().any());
    for (const int scene : {1, 5})
        learner.add(matchedPictures(sharpDiscs(scene), kDarker));
    ASSERT_FALSE(learner.filters()->tone().isIdentity());
    EXPECT_FALSE(learner.filters()->guidance().any())
        << "with another tone curve, guidance must be learned anew";
}

TEST(EnlargerLearner, AnOlderStillWithoutToneCurveGetsTheCurveOfNewStills) {
    constexpr SensorPair kNoisyAndDarker{.videoNoise = 4, .gain = 0.7, .gamma = 1.3};
    EnlargerLearner learner;
    for (const int scene : {1, 2})
        learner.add(matchedPictures(sharpDiscs(scene), kNoisyAndDarker));
    const StillTone tone = learner.filters()->tone();
    ASSERT_FALSE(tone.isIdentity());
    MatchedPictures older = matchedPictures(sharpDiscs(5), kNoisyAndDarker);
    const int level = older.still[200][300];
    EXPECT_EQ(learner.addOlder(matchedPictures(sharpDiscs(5), kNoisyAndDarker), older),
              EnlargerLearner::Outcome::Replaced);
    EXPECT_EQ(older.tone, tone);
    EXPECT_EQ(older.still[200][300], tone.levels[static_cast<std::size_t>(level)]);
}

}  // namespace
}  // namespace mfar::enlarge
