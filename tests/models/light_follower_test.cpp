#include "pipeline/models/light_follower.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace mfar {
namespace {

using namespace std::chrono_literals;

const CameraModel kWideLens{{64, 48}, 56, 56, 31.5, 23.5, {}};

std::optional<Lighting> followed(LightFollower& light, std::chrono::milliseconds at,
                                 std::uint8_t grey = 180) {
    const std::vector<std::uint8_t> pixels(4UL * 64 * 48, grey);
    return light.follow({pixels.data(), {64, 48}, 256, PixelFormat::Rgba8}, kWideLens, {},
                        Timestamp{} + at);
}

TEST(LightFollower, LightChangesAtMostTwiceASecond) {
    LightFollower light({});
    int changes = 0;
    for (auto at = 33ms; at < 2s; at += 33ms)
        changes += followed(light, at) ? 1 : 0;
    EXPECT_EQ(changes, 4);
}

TEST(LightFollower, ACoveredLensDoesNotChangeTheLight) {
    LightFollower light({});
    EXPECT_FALSE(followed(light, 0ms, 0));
    EXPECT_TRUE(followed(light, 600ms));
    EXPECT_FALSE(followed(light, 1200ms, 0));
    EXPECT_TRUE(followed(light, 1800ms));
}

TEST(LightFollower, AConfiguredSunIsKept) {
    Sun sun;
    sun.towards = {0.6F, 0, 0.8F};
    LightFollower light(sun);
    const auto lighting = followed(light, 33ms);
    ASSERT_TRUE(lighting && lighting->sun);
    EXPECT_EQ(lighting->sun->towards, sun.towards);
    LightFollower without({});
    const auto even = followed(without, 33ms);
    ASSERT_TRUE(even);
    EXPECT_FALSE(even->sun && even->sun->towards == sun.towards);
}

}  // namespace
}  // namespace mfar
