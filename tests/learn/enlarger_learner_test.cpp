#include "pipeline/enlarge/enlarger_learner.h"
#include "tests/learn/sensor_pair.h"

#include <algorithm>
#include <chrono>
#include <gmock/gmock.h>
#include <thread>

namespace mfar {
namespace {

using Outcome = EnlargerLearner::Outcome;

constexpr unsigned kFresh = 1000;

SensorPair seeded(SensorPair pair, unsigned seed) {
    pair.seed = seed;
    return pair;
}

EnlargerLearner learned(const SensorPair& pair, int stills = 6) {
    EnlargerLearner out;
    for (int i = 1; i <= stills; ++i)
        out.add(matchedPictures(sharpDiscs(i), seeded(pair, i)));
    return out;
}

struct Errors {
    double cubic, shipped, learned;
};
Errors errorsOf(const EnlargerLearner& learner, const SensorPair& pair) {
    const twin::Grey sharp = sharpDiscs(kFresh);
    return {enlargingError(sharp, pair, nullptr), enlargingError(sharp, pair, &FilterBank::prior()),
            enlargingError(sharp, pair, learner.filters().get())};
}

bool sameFilters(const FilterBank& a, const FilterBank& b) {
    for (int i = 0; i < enlarge::GradientClasses::kCount; ++i)
        if (!std::equal(a.gradient()[i], a.gradient()[i] + enlarge::kFilterSize, b.gradient()[i]))
            return false;
    for (int i = 0; i < enlarge::CurvatureClasses::kCount; ++i)
        if (!std::equal(a.curvature()[i], a.curvature()[i] + enlarge::kFilterSize,
                        b.curvature()[i]))
            return false;
    return true;
}

TEST(EnlargerLearner, BeforeTheFirstStillTheFiltersAreTheShippedOnes) {
    const EnlargerLearner learner;
    EXPECT_TRUE(sameFilters(*learner.filters(), FilterBank::prior()));
    EXPECT_EQ(learner.counts().classes, 0);
}

TEST(EnlargerLearner, LearnedFiltersFitABlurrierVideo) {
    const SensorPair pair{.videoBlur = 2};
    const EnlargerLearner learner = learned(pair);
    const Errors errors = errorsOf(learner, pair);
    EXPECT_LT(errors.learned, 0.8 * errors.shipped);
    EXPECT_LT(errors.learned, 0.7 * errors.cubic);
    EXPECT_GT(learner.counts().gainDb, learner.counts().priorDb + 0.7);
    EXPECT_EQ(learner.counts().stills, 6U);
}

TEST(EnlargerLearner, LearnedFiltersFitANoisyVideo) {
    const SensorPair pair{.videoNoise = 6, .stillNoise = 3};
    const Errors errors = errorsOf(learned(pair), pair);
    EXPECT_LT(errors.learned, 0.97 * errors.shipped);
    EXPECT_LT(errors.learned, 0.9 * errors.cubic);
}

TEST(EnlargerLearner, ExposureAndGammaOfTheStillAreNotLearned) {
    const SensorPair pair{.videoBlur = 1};
    SensorPair darker = pair;
    darker.gain = 0.7;
    darker.gamma = 1.3;
    const double same = errorsOf(learned(pair), pair).learned,
                 other = errorsOf(learned(darker), pair).learned;
    EXPECT_LT(other, 1.05 * same);
}

TEST(EnlargerLearner, MatchesOffByAFifthOfAPixelHardlyRaiseTheError) {
    const SensorPair pair{.videoBlur = 1};
    SensorPair off = pair;
    off.shift = 0.2;
    const double same = errorsOf(learned(pair), pair).learned,
                 other = errorsOf(learned(off), pair).learned;
    EXPECT_LT(other, 1.05 * same);
}

TEST(EnlargerLearner, StillsWithWrongOrUntrustedMatchesAreRefused) {
    EnlargerLearner learner;
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), sharpDiscs(2), {})), Outcome::Refused);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), {.weight = 0})), Outcome::Refused);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), {.confidence = 0})), Outcome::Refused);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), {.shift = 3})), Outcome::Refused);
    EXPECT_EQ(learner.counts().refused, 4U);
    EXPECT_TRUE(sameFilters(*learner.filters(), FilterBank::prior()));
}

TEST(EnlargerLearner, AToneCurveWithWhichStillsAreRefusedIsDropped) {
    const SensorPair darker{.gain = 0.3};
    EnlargerLearner learner = learned(darker, 2);
    const StillTone curve = learner.filters()->tone();
    ASSERT_FALSE(curve.isIdentity());
    // The curve was learned from dark stills. It would make most of a still with the video's
    // exposure white. Here, the whole still is white.
    const auto overexposed = [&](int seed) {
        MatchedPictures out = matchedPictures(sharpDiscs(seed), seeded({}, seed));
        for (int y = 0; y < out.still.size().height; ++y)
            for (int x = 0; x < out.still.size().width; ++x)
                out.still[y][x] = 255;
        out.tone = curve;
        return out;
    };
    EXPECT_EQ(learner.add(overexposed(11)), Outcome::Refused);
    EXPECT_EQ(learner.add(overexposed(12)), Outcome::Refused);
    EXPECT_EQ(learner.filters()->tone(), curve);
    EXPECT_EQ(learner.add(overexposed(13)), Outcome::Replaced);
    EXPECT_TRUE(learner.filters()->tone().isIdentity());
}

TEST(EnlargerLearner, StillsOutOfFocusAreRefused) {
    EnlargerLearner learner;
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), {.stillBlur = 12})), Outcome::Refused);
    EXPECT_TRUE(sameFilters(*learner.filters(), FilterBank::prior()));
}

TEST(EnlargerLearner, ASoftStillIsRefusedUnlessTheStillBeforeWasAlsoSoft) {
    constexpr SensorPair kSharp{.videoBlur = 1}, kSoft{.videoBlur = 1, .stillBlur = 12};
    EnlargerLearner learner = learned(kSharp, 3);
    const auto before = learner.filters();
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(11), kSoft)), Outcome::Refused);
    EXPECT_EQ(learner.filters(), before);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(12), kSharp)), Outcome::Replaced);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(13), kSoft)), Outcome::Refused);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(14), kSoft)), Outcome::Replaced)
        << "a second soft still in a row means that the lens has changed";
}

TEST(EnlargerLearner, BadStillsNeverGiveFiltersWorseThanCubicInterpolation) {
    for (const SensorPair& good : {SensorPair{}, SensorPair{.videoBlur = 1, .videoNoise = 2}}) {
        EnlargerLearner learner;
        for (int i = 1; i <= 8; ++i) {
            const twin::Grey sharp = sharpDiscs(i);
            SensorPair bad = seeded(good, i);
            bad.shift = i % 4 == 1 ? 0.7 : 0;
            bad.stillBlur = i % 4 == 2 ? 6 : 0;
            bad.stillNoise = i % 4 == 3 ? 40 : 0;
            const twin::Grey other = i % 4 == 0 ? sharpDiscs(i + 100) : sharp;
            learner.add(matchedPictures(sharp, other, bad));
            const Errors errors = errorsOf(learner, good);
            EXPECT_LE(errors.learned, errors.cubic) << "after still " << i;
        }
    }
}

TEST(EnlargerLearner, ClassesWithFewPixelsKeepTheShippedFilters) {
    // All edges have the same direction. Classes of other directions stay empty.
    const auto stripes = [](int phase) {
        return twin::greyOf({1024, 768}, [phase](int x, int) {
            return 60.0 + 120 * ((x + 7 * phase) / 37 % 2) + 8 * ((x / 37) % 5);
        });
    };
    EnlargerLearner learner;
    for (int i = 0; i < 4; ++i)
        learner.add(matchedPictures(stripes(i), {.videoBlur = 1}));
    ASSERT_GT(learner.counts().classes, 0);
    using G = enlarge::GradientClasses;
    const auto same = [&](int row) {
        return std::equal(learner.filters()->gradient()[row],
                          learner.filters()->gradient()[row] + enlarge::kFilterSize,
                          FilterBank::prior().gradient()[row]);
    };
    const int diagonal = G::kAngles / 4;  // angle bins begin at -pi/2
    for (int kind = 0; kind < G::kKinds; ++kind)
        EXPECT_TRUE(same(diagonal * G::kKinds + kind)) << kind;
    EXPECT_FALSE(sameFilters(*learner.filters(), FilterBank::prior()));
}

TEST(EnlargerLearner, RepeatedStillsAreIgnored) {
    EnlargerLearner learner;
    const SensorPair pair{.videoNoise = 1};
    EXPECT_NE(learner.add(matchedPictures(sharpDiscs(1), pair)), Outcome::Repeated);
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), seeded(pair, 2))), Outcome::Repeated);
    EXPECT_EQ(learner.counts().repeated, 1U);
    EXPECT_EQ(learner.counts().stills, 1U);
    EXPECT_NE(learner.add(matchedPictures(sharpDiscs(3), pair)), Outcome::Repeated);
}

TEST(EnlargerLearner, ADarkStillAfterARefusedOneIsNotTakenForARepeatedOne) {
    twin::Grey dark = sharpDiscs(1);
    for (double& value : dark.values)
        value /= 64;
    EnlargerLearner learner;
    EXPECT_EQ(learner.add(matchedPictures(dark, {.confidence = 0})), Outcome::Refused);
    EXPECT_NE(learner.add(matchedPictures(dark, {})), Outcome::Repeated);
}

TEST(EnlargerLearner, TheSamePicturesGiveTheSameFilters) {
    const SensorPair pair{.videoBlur = 1, .videoNoise = 2};
    EXPECT_EQ(learned(pair, 3).stored("x"), learned(pair, 3).stored("x"));
    EXPECT_NE(learned(pair, 3).stored("x"), learned(pair, 2).stored("x"));
}

TEST(EnlargerLearner, StopRequestDiscardsTheCurrentStill) {
    std::stop_source stop;
    stop.request_stop();
    EnlargerLearner learner;
    const auto before = learner.stored("x");
    EXPECT_EQ(learner.add(matchedPictures(sharpDiscs(1), {}), stop.get_token()), Outcome::Stopped);
    EXPECT_EQ(learner.stored("x"), before);
    EXPECT_NE(learner.add(matchedPictures(sharpDiscs(1), {})), Outcome::Repeated);
}

TEST(EnlargerLearner, AStillIsUsedAsAWholeOrNotAtAll) {
    const MatchedPictures pictures = matchedPictures(sharpDiscs(1, {128, 96}), {});
    EnlargerLearner whole;
    const auto before = whole.stored("x");
    const auto begun = std::chrono::steady_clock::now();
    ASSERT_NE(whole.add(pictures), Outcome::Stopped);
    const auto took = std::chrono::steady_clock::now() - begun;
    for (int i = 1; i < 8; ++i) {
        std::stop_source stop;
        EnlargerLearner learner;
        std::jthread stopper([&] {
            std::this_thread::sleep_for(i * took / 8);
            stop.request_stop();
        });
        const bool isStopped = learner.add(pictures, stop.get_token()) == Outcome::Stopped;
        EXPECT_EQ(learner.stored("x"), isStopped ? before : whole.stored("x")) << i;
    }
}

}  // namespace
}  // namespace mfar
