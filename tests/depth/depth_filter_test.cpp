#include "pipeline/depth/depth_filter.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mfar {
namespace {

using test::motion;

const CameraModel kCamera{{120, 90}, 110, 110, 59.5, 44.5, {}};
constexpr PixelRect kWhole{0, 0, 120, 90};

DepthFilter filterOf() {
    return {kCamera, std::make_shared<Workers>(2)};
}

InverseDepthField evenField(float inverseDepth, float sigma) {
    InverseDepthField out(kCamera.size);
    std::fill(out.inverseDepth.begin(), out.inverseDepth.end(), inverseDepth);
    std::fill(out.variance.begin(), out.variance.end(), sigma * sigma);
    return out;
}

std::size_t middle() {
    return 45UL * 120 + 60;
}

TEST(DepthFilter, MeasurementNoiseIsAveragedOverTheFrames) {
    DepthFilter filter = filterOf();
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, 0.05F);
    double before = 0, after = 0;
    for (int frame = 0; frame < 12; ++frame) {
        InverseDepthField measured = evenField(1, 0.05F);
        for (float& inverseDepth : measured.inverseDepth)
            inverseDepth += noise(random);
        filter.predict({}, 1.0 / 30);
        filter.fuse(measured, kWhole);
        after = 0;
        for (const float inverseDepth : filter.field().inverseDepth)
            after += std::abs(inverseDepth - 1);
        if (frame == 0) before = after;
    }
    EXPECT_LT(after, 0.45 * before);
    EXPECT_LT(filter.field().variance[middle()], 0.05F * 0.05F);
}

TEST(DepthFilter, AnInaccurateMeasurementDoesNotMakeKnownDepthLessCertain) {
    DepthFilter filter = filterOf();
    filter.fuse(evenField(1, 0.01F), kWhole);
    const float before = filter.field().variance[middle()];
    filter.fuse(evenField(1.01F, 0.1F), kWhole);
    EXPECT_LE(filter.field().variance[middle()], before);
    EXPECT_NEAR(filter.field().inverseDepth[middle()], 1, 0.001F);
}

TEST(DepthFilter, OneOutlierIsIgnoredAndALastingChangeIsFollowed) {
    DepthFilter filter = filterOf();
    filter.predict({}, 0);
    filter.fuse(evenField(1, 0.02F), kWhole);
    filter.fuse(evenField(3, 0.02F), kWhole);
    EXPECT_NEAR(filter.field().inverseDepth[middle()], 1, 1e-5);
    filter.fuse(evenField(1, 0.02F), kWhole);
    filter.fuse(evenField(3, 0.02F), kWhole);
    EXPECT_NEAR(filter.field().inverseDepth[middle()], 1, 1e-5);
    filter.fuse(evenField(3, 0.02F), kWhole);
    EXPECT_NEAR(filter.field().inverseDepth[middle()], 3, 1e-5);
}

TEST(DepthFilter, ContradictedDepthIsForgottenAtOnceOnlyWhereMostOfABlockIsContradicted) {
    DepthFilter filter = filterOf();
    filter.predict({}, 0);
    filter.fuse(evenField(1, 0.02F), kWhole);
    InverseDepthField measured = evenField(1.01F, 0.02F);
    const auto at = [](int x, int y) { return static_cast<std::size_t>(y) * 120 + x; };
    for (int y = 32; y < 48; ++y)
        for (int x = 32; x < 48; ++x) {
            if (x < 41) measured.inverseDepth[at(x, y)] = 3;
            if (x < 39) measured.inverseDepth[at(x + 32, y)] = 3;
        }
    filter.forgetContradicted(measured, kWhole);
    std::size_t forgotten = 0;
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 120; ++x)
            forgotten += filter.field().isKnown(at(x, y)) ? 0 : 1;
    EXPECT_EQ(forgotten, 16U * 9);
    EXPECT_FALSE(filter.field().isKnown(at(40, 32)));
    filter.fuse(measured, kWhole);
    EXPECT_NEAR(filter.field().inverseDepth[at(40, 32)], 3, 1e-5);
    EXPECT_NEAR(filter.field().inverseDepth[at(66, 32)], 1, 1e-5);
}

TEST(DepthFilter, ANearerSurfaceOccludesAFartherSurface) {
    DepthFilter filter = filterOf();
    filter.predict({}, 0);
    InverseDepthField measured = evenField(0.5F, 0.01F);
    for (int y = 30; y < 60; ++y)
        for (int x = 40; x < 60; ++x)
            measured.inverseDepth[static_cast<std::size_t>(y) * 120 + x] = 2;
    filter.fuse(measured, kWhole);
    // The camera moves 0.1 m to the right. So the near square moves 22 px to the left and the
    // background 5.5 px.
    filter.predict(motion({0, 0, 0}, {0.1, 0, 0}), 0);
    const auto at = [&](int x) { return filter.field().inverseDepth[45UL * 120 + x]; };
    EXPECT_NEAR(at(28), 2, 1e-4);
    EXPECT_NEAR(at(12), 0.5, 1e-4);
    EXPECT_NEAR(at(70), 0.5, 1e-4);
    EXPECT_FALSE(filter.field().isKnown(45UL * 120 + 45))
        << "the uncovered background must be unknown";
}

TEST(DepthFilter, DepthFollowsTheMotionOfTheCamera) {
    DepthFilter filter = filterOf();
    filter.predict({}, 0);
    filter.fuse(evenField(1, 0.02F), kWhole);
    const float variance = filter.field().variance[middle()];
    filter.predict(motion({0, 0, 0}, {0, 0, 0.5}), 0);
    ASSERT_TRUE(filter.field().isKnown(middle()));
    EXPECT_NEAR(filter.field().inverseDepth[middle()], 2, 1e-4);
    EXPECT_GT(filter.field().variance[middle()], 10 * variance);
    filter.predict(motion({0, 0, 0}, {0, 0, 1.2}), 0);
    EXPECT_FALSE(filter.field().isKnown(middle()));
}

TEST(DepthFilter, TheVarianceGrowsWithTimeOnlyIfTheCameraMoves) {
    DepthFilter filter = filterOf();
    filter.predict({}, 0);
    filter.fuse(evenField(1, 0.02F), kWhole);
    const float variance = filter.field().variance[middle()];
    filter.predict({}, 10);
    EXPECT_EQ(filter.field().variance[middle()], variance);
    filter.predict(motion({1, 0, 0}, {0, 0, 0}), 0.1);
    EXPECT_GT(filter.field().variance[middle()], variance);
    EXPECT_LT(filter.field().variance[middle()], 1.25F * variance);
}

TEST(DepthFilter, SmallMotionsAddUpWithoutBlur) {
    DepthFilter filter = filterOf();
    filter.predict({}, 0);
    InverseDepthField measured = evenField(1, 0.01F);
    measured.inverseDepth[middle()] = 2;
    filter.fuse(measured, kWhole);
    for (int i = 1; i <= 1000; ++i)
        filter.predict(motion({0, 0, 0}, {2e-5 * i, 0, 0}), 0);
    // The camera moved 2 cm to the right. At a depth of half a metre, this moves the point by 4.4
    // px to the left.
    EXPECT_NEAR(filter.field().inverseDepth[middle() - 4], 2, 1e-3);
}

}  // namespace
}  // namespace mfar
