#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/stored_numbers.h"
#include "tests/learn/sensor_pair.h"

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::HasSubstr;

constexpr SensorPair kPair{.videoBlur = 1};

EnlargerLearner learned() {
    EnlargerLearner out;
    for (int i = 1; i <= 3; ++i)
        out.add(matchedPictures(sharpDiscs(i), kPair));
    MatchedPictures noisy = matchedPictures(sharpDiscs(5), {.videoNoise = 4});
    out.addOlder(noisy, noisy);
    return out;
}

std::string faultOf(std::span<const std::uint8_t> bytes, const std::string& key = "a, b") {
    try {
        (void)EnlargerLearner::restored(bytes, key, "state");
    } catch (const FilterBankError& e) {
        return e.what();
    }
    return "";
}

TEST(LearnerState, RestoredLearnerEqualsTheStoredOneAndLearnsTheSameFromANewStill) {
    EnlargerLearner first = learned();
    ASSERT_GT(first.counts().classes, 0);
    const auto bytes = first.stored("a, b");
    EnlargerLearner second = EnlargerLearner::restored(bytes, "a, b", "state");
    EXPECT_EQ(second.stored("a, b"), bytes);
    EXPECT_EQ(second.counts().stills, first.counts().stills);
    EXPECT_EQ(second.counts().classes, first.counts().classes);
    EXPECT_DOUBLE_EQ(second.counts().gainDb, first.counts().gainDb);
    EXPECT_GT(second.filters()->guidance().still, 0.5);
    EXPECT_EQ(second.filters()->guidance(), first.filters()->guidance());
    for (EnlargerLearner* learner : {&first, &second})
        learner->add(matchedPictures(sharpDiscs(9), kPair));
    EXPECT_EQ(second.stored("a, b"), first.stored("a, b"));
}

TEST(LearnerState, StateOfOtherSensorsIsRefused) {
    EXPECT_EQ(faultOf(EnlargerLearner().stored("a, b"), "a, c"),
              "state: was learned from another pair of sensors");
}

TEST(LearnerState, DamagedStatesAreRefused) {
    const auto whole = learned().stored("a, b");
    EXPECT_EQ(faultOf(whole), "");
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{12}, std::size_t{40},
                                   whole.size() / 2, whole.size() - 1})
        EXPECT_NE(faultOf(std::span(whole).first(size)), "") << size;
    for (const std::size_t at : {std::size_t{16}, whole.size() / 2, whole.size() - 1}) {
        auto damaged = whole;
        damaged[at] ^= 16;
        EXPECT_EQ(faultOf(damaged), "state: is damaged: the checksum is wrong") << at;
    }
    auto damaged = whole;
    damaged[8] = 9;
    EXPECT_EQ(faultOf(damaged),
              "state: has a format version that this version of mfar does not support");
}

TEST(LearnerState, NonFiniteNumbersAreRefusedDespiteAValidChecksum) {
    auto bytes = learned().stored("a, b");
    bytes.resize(bytes.size() - 4);
    for (std::size_t i = bytes.size() - 8; i < bytes.size(); ++i)
        bytes[i] = 0xff;
    enlarge::putNumber(bytes, enlarge::fnv1a(bytes), 4);
    EXPECT_THAT(faultOf(bytes), HasSubstr("not finite"));
}

constexpr std::size_t kGuidanceSize = 8 * enlarge::GuidanceLearner::kOldNumbers,
                      kLightSize = 8 * enlarge::GuidanceLearner::kNumbers - kGuidanceSize,
                      kFineMatchSize = 8 * enlarge::FineMatchLearner::kNumbers,
                      kToneSize = 8 * enlarge::ToneLearner::kNumbers, kToneInUseSize = 8;

TEST(LearnerState, StatesOfVersionsOneAndTwoAreReadWithoutGuidance) {
    const EnlargerLearner now = learned();
    for (const auto& [version, numbers] : {std::pair{1, 0}, {2, 10}}) {
        auto bytes = now.stored("a, b");
        bytes.resize(bytes.size() - 4 - kGuidanceSize - kFineMatchSize - kToneSize - kLightSize);
        bytes[8] = static_cast<std::uint8_t>(version);
        bytes.resize(bytes.size() + 8U * numbers);
        enlarge::putNumber(bytes, enlarge::fnv1a(bytes), 4);
        const EnlargerLearner then = EnlargerLearner::restored(bytes, "a, b", "state");
        EXPECT_FALSE(then.filters()->guidance().any()) << version;
        EXPECT_EQ(then.counts().pairs, 0U);
        EXPECT_EQ(then.counts().stills, now.counts().stills);
        EXPECT_DOUBLE_EQ(then.counts().gainDb, now.counts().gainDb);
        EXPECT_FALSE(then.filters()->fineMatch().isKnown());
    }
}

TEST(LearnerState, StateOfVersionThreeIsReadWithGuidanceButWithoutFineMatch) {
    const EnlargerLearner now = learned();
    auto bytes = now.stored("a, b");
    bytes.resize(bytes.size() - 4 - kFineMatchSize - kToneSize - kLightSize);
    bytes[8] = 3;
    enlarge::putNumber(bytes, enlarge::fnv1a(bytes), 4);
    const EnlargerLearner then = EnlargerLearner::restored(bytes, "a, b", "state");
    EXPECT_EQ(then.filters()->guidance(), now.filters()->guidance());
    EXPECT_FALSE(then.filters()->fineMatch().isKnown());
}

TEST(LearnerState, StateOfVersionSevenIsReadWithGuidanceButWithoutLight) {
    EnlargerLearner now;
    const SensorPair sensors{.videoNoise = 3, .averagesLight = true};
    const auto truth = matchedPictures(sharpDiscs(1), sensors);
    auto older = matchedPictures(sharpDiscs(1), sensors);
    now.addOlder(truth, older);
    ASSERT_GT(now.filters()->guidance().light, 0.5F);
    const auto whole = now.stored("a, b");
    EXPECT_EQ(EnlargerLearner::restored(whole, "a, b", "state").filters()->guidance(),
              now.filters()->guidance());
    auto bytes = whole;
    bytes.resize(bytes.size() - 4 - kLightSize);
    bytes[8] = 7;
    enlarge::putNumber(bytes, enlarge::fnv1a(bytes), 4);
    const Guidance then = EnlargerLearner::restored(bytes, "a, b", "state").filters()->guidance();
    EXPECT_EQ(then.still, now.filters()->guidance().still);
    EXPECT_EQ(then.light, 0);
}

TEST(LearnerState, StatesBeforeVersionSixAreReadWithoutFineMatchAndBeforeFiveWithoutTone) {
    EnlargerLearner now;
    for (const int scene : {1, 5})
        now.add(matchedPictures(sharpDiscs(scene), {.gain = 0.7, .gamma = 1.3}));
    ASSERT_FALSE(now.filters()->tone().isIdentity());
    ASSERT_TRUE(now.filters()->fineMatch().isKnown());
    const auto whole = now.stored("a, b");
    const EnlargerLearner again = EnlargerLearner::restored(whole, "a, b", "state");
    EXPECT_EQ(again.filters()->tone(), now.filters()->tone());
    EXPECT_EQ(again.filters()->fineMatch(), now.filters()->fineMatch());
    for (const int version : {4, 5, 6}) {
        auto bytes = whole;
        bytes.resize(bytes.size() - 4 - kLightSize - (version == 4 ? kToneSize : kToneInUseSize));
        bytes[8] = static_cast<std::uint8_t>(version);
        enlarge::putNumber(bytes, enlarge::fnv1a(bytes), 4);
        const EnlargerLearner then = EnlargerLearner::restored(bytes, "a, b", "state");
        EXPECT_EQ(then.filters()->fineMatch().isKnown(), version == 6) << version;
        if (version == 4)
            EXPECT_TRUE(then.filters()->tone().isIdentity());
        else
            EXPECT_EQ(then.filters()->tone(), now.filters()->tone());
    }
}

TEST(LearnerState, NumbersOutOfRangeAreRefusedDespiteAValidChecksum) {
    auto bytes = learned().stored("a, b");
    bytes.resize(bytes.size() - 4);
    const std::size_t tone = bytes.size() - kLightSize,
                      guidance = tone - kToneSize - kFineMatchSize - kGuidanceSize;
    // Changes an exponent, so that the number is far above its range.
    for (const auto& [at, fault] :
         {std::pair{guidance + 15, "guidance factors that are out of range"},
          {tone - kToneSize - 1, "fine_share that are out of range"},
          {tone - kToneInUseSize - 1, "tone curve that are out of range"},
          {tone + 7, "guidance factors that are out of range"}}) {
        auto wrong = bytes;
        wrong[at] ^= 0x41;
        enlarge::putNumber(wrong, enlarge::fnv1a(wrong), 4);
        EXPECT_THAT(faultOf(wrong), HasSubstr(fault));
    }
}

TEST(LearnerState, WrongLengthIsRefusedDespiteAValidChecksum) {
    auto bytes = EnlargerLearner().stored("a, b");
    bytes.resize(bytes.size() - 4);
    auto longer = bytes;
    longer.push_back(0);
    enlarge::putNumber(longer, enlarge::fnv1a(longer), 4);
    EXPECT_THAT(faultOf(longer), HasSubstr("longer than this program expects"));
    bytes.pop_back();
    enlarge::putNumber(bytes, enlarge::fnv1a(bytes), 4);
    EXPECT_THAT(faultOf(bytes), HasSubstr("shorter than this program expects"));
}

}  // namespace
}  // namespace mfar
