#include "pipeline/depth/keyframes.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace mfar {
namespace {

const CameraModel kKeyCamera{{160, 120}, 150, 150, 79.5, 59.5, {}};

const PixelRect kAll{0, 0, 160, 120};

Pose poseAt(double x, double z = 0) {
    Pose pose;
    pose.T_world_video.translation = {x, 0, z};
    return pose;
}

LumaImage grey(int value) {
    LumaImage out(kKeyCamera.size);
    std::fill(out.pixels.begin(), out.pixels.end(), static_cast<std::uint8_t>(value));
    return out;
}

/// Keyframes of a camera that moved from 0 to 9 cm, one per centimetre.
Keyframes walked(const KeyframeOptions& options, int brightness = 100) {
    Keyframes out(kKeyCamera, options);
    for (int i = 0; i < 10; ++i)
        out.add(grey(brightness), poseAt(0.01 * i), brightness, 1);
    return out;
}

TEST(Keyframes, FixedRuleChoosesTheKeyframeAFixedNumberOfFramesBack) {
    const Keyframes frames = walked({.rule = KeyframeRule::Fixed, .distance = 4});
    const auto choice = frames.choose(poseAt(0.1), 100, kAll, 1);
    ASSERT_TRUE(choice);
    EXPECT_NEAR(choice->frame->pose.T_world_video.translation.x(), 0.06, 1e-12);
}

TEST(Keyframes, AngleRuleChoosesTheNewestKeyframeWithEnoughParallax) {
    const Keyframes frames = walked({.rule = KeyframeRule::Angle, .angle = 0.035});
    const auto choice = frames.choose(poseAt(0.1), 100, kAll, 1);
    ASSERT_TRUE(choice);
    EXPECT_NEAR(choice->frame->pose.T_world_video.translation.x(), 0.06, 1e-12);
    EXPECT_GT(choice->angle, 0.035);
}

TEST(Keyframes, ScoreRuleChoosesTheMostParallaxAmongKeyframesThatShowTheRegion) {
    const Keyframes frames = walked({});
    EXPECT_EQ(frames.choose(poseAt(0.1), 100, kAll, 1)->frame->pose.T_world_video.translation.x(),
              0);
    // At an inverse depth of 8, surfaces are so near that the keyframes farthest from the camera
    // show other parts of the scene.
    const auto near = frames.choose(poseAt(0.1), 100, kAll, 8);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->frame->pose.T_world_video.translation.x(), 0.06, 0.011);
}

TEST(Keyframes, KeyframesOfSimilarExposureArePreferred) {
    Keyframes frames(kKeyCamera, {});
    frames.add(grey(30), poseAt(0), 30, 1);
    frames.add(grey(100), poseAt(0.04), 100, 1);
    EXPECT_NEAR(frames.choose(poseAt(0.1), 100, kAll, 1)->frame->brightness, 100, 1e-9);
    EXPECT_NEAR(frames.choose(poseAt(0.1), 30, kAll, 1)->frame->brightness, 30, 1e-9);
}

TEST(Keyframes, ARestingCameraKeepsItsKeyframes) {
    Keyframes frames = walked({});
    for (int i = 0; i < 300; ++i)
        frames.add(grey(100), poseAt(0.09), 100, 1);
    ASSERT_TRUE(frames.choose(poseAt(0.09), 100, kAll, 1));
    EXPECT_LT(frames.choose(poseAt(0.09), 100, kAll, 1)->frame->pose.T_world_video.translation.x(),
              0.05);
}

TEST(Keyframes, WithoutParallaxThereIsNoKeyframe) {
    Keyframes frames(kKeyCamera, {});
    EXPECT_FALSE(frames.choose(poseAt(0), 100, kAll, 1));
    frames.add(grey(100), poseAt(0), 100, 1);
    EXPECT_FALSE(frames.choose(poseAt(0), 100, kAll, 1));
    EXPECT_FALSE(frames.choose(poseAt(0.1), 100, kAll, 0));
    EXPECT_FALSE(frames.choose(poseAt(0.1), 100, kAll, std::numeric_limits<double>::quiet_NaN()));
    EXPECT_TRUE(frames.choose(poseAt(0.1), 100, kAll, 1));
    EXPECT_TRUE(frames.choose(poseAt(0, 0.2), 100, kAll, 1)) << "a forward motion causes parallax";
    frames.forget();
    EXPECT_FALSE(frames.choose(poseAt(0.1), 100, kAll, 1));
}

TEST(Keyframes, RegionsAtTheEpipoleHaveNoKeyframe) {
    Keyframes frames(kKeyCamera, {});
    frames.add(grey(100), poseAt(0), 100, 1);
    EXPECT_FALSE(frames.choose(poseAt(0, 0.06), 100, {70, 50, 90, 70}, 1));
    EXPECT_TRUE(frames.choose(poseAt(0, 0.06), 100, {0, 0, 40, 120}, 1));
}

TEST(Keyframes, OptionsOutOfRangeAreRefused) {
    EXPECT_THROW(Keyframes(kKeyCamera, {.frames = 1}), std::invalid_argument);
    EXPECT_THROW(Keyframes(kKeyCamera, {.frames = 5, .distance = 5}), std::invalid_argument);
    EXPECT_THROW(Keyframes(kKeyCamera, {.angle = 0}), std::invalid_argument);
    EXPECT_THROW(Keyframes(kKeyCamera, {.leastOverlap = std::numeric_limits<double>::quiet_NaN()}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace mfar
