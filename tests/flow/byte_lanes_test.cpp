#include "pipeline/epipolar/byte_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace mfar {
namespace {

using Lanes = std::array<std::uint8_t, 16>;

Lanes lanesOf(Bytes16 v) {
    Lanes out;
    storeBytes(out.data(), v);
    return out;
}

TEST(ByteLanes, LoadAndStoreNeedNoAlignment) {
    std::array<std::uint8_t, 64> from{}, to{};
    for (int i = 0; i < 64; ++i)
        from[i] = static_cast<std::uint8_t>(3 * i);
    for (int at = 0; at < 32; ++at) {
        to.fill(255);
        storeBytes(to.data() + at, loadBytes(from.data() + at + 1));
        for (int i = 0; i < 16; ++i)
            ASSERT_EQ(to[at + i], from[at + 1 + i]) << at;
        ASSERT_EQ(to[at + 16], 255);
        ASSERT_TRUE(at == 0 || to[at - 1] == 255);
    }
}

TEST(ByteLanes, SpreadFillsEveryLane) {
    for (int value = 0; value < 256; ++value)
        for (const std::uint8_t lane : lanesOf(spread(static_cast<std::uint8_t>(value))))
            ASSERT_EQ(lane, value);
}

TEST(ByteLanes, LesserIsUnsignedLaneByLane) {
    for (int a = 0; a < 256; a += 5) {
        for (int b = 0; b < 256; ++b) {
            Lanes x{}, y{};
            x.fill(static_cast<std::uint8_t>(a));
            y.fill(static_cast<std::uint8_t>(b));
            std::swap(x[b % 16], y[b % 16]);
            for (const std::uint8_t lane :
                 lanesOf(lesser(loadBytes(x.data()), loadBytes(y.data()))))
                ASSERT_EQ(lane, std::min(a, b));
        }
    }
}

TEST(ByteLanes, LeastOfFindsItInEveryLane) {
    for (int place = 0; place < 16; ++place) {
        for (const int least : {0, 1, 7, 127, 128, 199, 254}) {
            Lanes lanes;
            lanes.fill(255);
            lanes[place] = static_cast<std::uint8_t>(least);
            for (const std::uint8_t lane : lanesOf(leastOf(loadBytes(lanes.data()))))
                ASSERT_EQ(lane, least) << "at " << place;
        }
    }
}

TEST(ByteLanes, LeastOfRandomBytesIsTheirMinimum) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> byte(0, 255);
    for (int round = 0; round < 2000; ++round) {
        Lanes lanes;
        for (std::uint8_t& lane : lanes)
            lane = static_cast<std::uint8_t>(byte(random));
        const std::uint8_t least = *std::min_element(lanes.begin(), lanes.end());
        for (const std::uint8_t lane : lanesOf(leastOf(loadBytes(lanes.data()))))
            ASSERT_EQ(lane, least);
    }
}

}  // namespace
}  // namespace mfar
