#include "pipeline/simd/still_noise.h"
#include "tests/oracle/enlarge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mfar::simd {
namespace {

using twin::Grey;

constexpr Size kStillSize{400, 300};

Grey plainScene(Size size = kStillSize) {
    return twin::greyOf(size, [](int x, int y) { return 60 + 0.2 * x + (y > x ? 70 : 0); });
}

/// Texture with the same contrast at each scale from 2 to 32 px, as in natural pictures.
Grey texture() {
    std::mt19937 random(5);
    std::normal_distribution<double> height(0, 6);
    Grey out = plainScene();
    for (int step = 2; step <= 32; step *= 2) {
        const Grey lattice =
            twin::greyOf({kStillSize.width / step + 2, kStillSize.height / step + 2},
                         [&](int, int) { return height(random); });
        for (int y = 0; y < kStillSize.height; ++y)
            for (int x = 0; x < kStillSize.width; ++x)
                out.values[static_cast<std::size_t>(y) * kStillSize.width + x] +=
                    lattice.bilinear(double(x) / step, double(y) / step);
    }
    return out;
}

double measured(const Grey& scene, double sigma, PixelFormat format = PixelFormat::Gray8) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 1);
    const std::size_t channels = format == PixelFormat::Gray8 ? 1 : 4;
    std::vector<std::uint8_t> bytes;
    for (const double value : scene.values)
        bytes.insert(bytes.end(), channels,
                     static_cast<std::uint8_t>(
                         std::clamp(std::round(value + sigma * noise(random)), 0.0, 255.0)));
    const auto width = static_cast<std::size_t>(scene.size.width);
    return noiseOfStill({bytes.data(), scene.size, channels * width, format});
}

TEST(StillNoise, WhiteNoiseIsFoundInEachFormat) {
    for (const double sigma : {1.5, 3.0, 6.0})
        for (const PixelFormat format : {PixelFormat::Gray8, PixelFormat::Rgba8})
            EXPECT_NEAR(measured(plainScene(), sigma, format), sigma, 0.15 * sigma);
}

TEST(StillNoise, TextureIsNotNoise) {
    EXPECT_LT(measured(texture(), 0), 0.5);
    EXPECT_GT(measured(texture(), 6), 4);
    EXPECT_LT(measured(texture(), 6), 6.5);
}

TEST(StillNoise, TheMeasuredNoiseOfCleanOrTinyStillsIsNearZero) {
    EXPECT_LT(measured(plainScene(), 0), 0.3);
    EXPECT_EQ(measured(plainScene({19, 300}), 5), 0);
    EXPECT_EQ(measured(plainScene({300, 19}), 5), 0);
    EXPECT_GT(measured(plainScene({64, 64}), 5), 3);
}

}  // namespace
}  // namespace mfar::simd
