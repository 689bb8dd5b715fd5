#include "pipeline/simd/edge_rows.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace mfar::simd {
namespace {

TEST(OpenRow, DepthIsDecidedAgainAtEdgesAndWhereItIsUnknown) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const std::size_t width : test::kLengths) {
        std::vector<float> low(3 * width, 1), high(3 * width, 1), inverseDepth(width, 1),
            variance(width);
        for (std::size_t x = 0; x < width; ++x) {
            variance[x] = x % 5 == 4 ? kInfinity : 0.0001F;  // sigma = 0.01
            if (x % 5 == 1) low[2 * width + x] = 0.5F;
            // below the limit, which is 8 % plus three sigmas
            if (x % 5 == 2) high[x] = 1.1F;
            if (x % 5 == 3) high[x] = 1.13F;  // above the limit
        }
        std::vector<std::uint8_t> open(width + 1, 99);
        openRow(low.data(), high.data(), static_cast<std::ptrdiff_t>(width), 3, inverseDepth.data(),
                variance.data(), width, {0.08F, 3}, open.data());
        for (std::size_t x = 0; x < width; ++x)
            EXPECT_EQ(open[x], x % 5 == 0 || x % 5 == 2 ? 0 : 1) << x;
        EXPECT_EQ(open[width], 99);
    }
}

struct Scene {
    Size size{61, 47};
    AlignedRows<float> inverseDepth{size}, variance{size}, red{size}, green{size}, blue{size};

    explicit Scene(double invalidShare) {
        std::mt19937 random(4);
        std::uniform_real_distribution<float> share(0, 1);
        for (int j = 0; j < size.height; ++j)
            for (int i = 0; i < size.width; ++i) {
                inverseDepth[j][i] = share(random) < invalidShare ? -1 : 1 + share(random);
                variance[j][i] = share(random);
                for (auto* channel : {&red, &green, &blue})
                    (*channel)[j][i] = std::floor(60 * share(random));
            }
    }
    [[nodiscard]] Voters voters() const {
        return {inverseDepth.rows(), variance.rows(), red.rows(), green.rows(), blue.rows()};
    }
};

/// Oracle of votePixels(), in double precision. `margin`: smallest change of a weight that would
/// give another decision.
OpenPixel decide(const Scene& scene, const VoteRule& rule, const PixelRect& where, int y,
                 OpenPixel pixel, double& margin) {
    const auto votes = [&](int i, int j) {
        const int u = kVoterStep * i, v = kVoterStep * j;
        return u >= where.x0 && u < where.x1 && v >= where.y0 && v < where.y1 &&
               std::abs(u - pixel.x) <= rule.radius && std::abs(v - y) <= rule.radius &&
               scene.inverseDepth[j][i] >= 0;
    };
    double low = 1e30, high = -1e30, weight[2] = {}, inverseDepth[2] = {}, variance[2] = {};
    for (int j = 0; j < scene.size.height; ++j)
        for (int i = 0; i < scene.size.width; ++i)
            if (votes(i, j)) {
                low = std::min<double>(low, scene.inverseDepth[j][i]);
                high = std::max<double>(high, scene.inverseDepth[j][i]);
            }
    for (int j = 0; j < scene.size.height; ++j)
        for (int i = 0; i < scene.size.width; ++i) {
            if (!votes(i, j)) continue;
            const double r = scene.red[j][i] - pixel.red, g = scene.green[j][i] - pixel.green;
            const double b = scene.blue[j][i] - pixel.blue;
            const double square = (r * r + g * g + b * b) / (rule.likeness * rule.likeness);
            const double w = 1 / (1 + square * square);
            const int side = scene.inverseDepth[j][i] > 0.5 * (low + high) ? 1 : 0;
            weight[side] += w;
            inverseDepth[side] += w * scene.inverseDepth[j][i];
            variance[side] += w * scene.variance[j][i];
        }
    const int side = weight[1] > weight[0] ? 1 : 0;
    margin = std::min(std::abs(weight[1] - weight[0]), std::abs(weight[side] - rule.leastWeight));
    pixel.decided = weight[side] >= rule.leastWeight;
    if (pixel.decided) {
        pixel.inverseDepth = static_cast<float>(inverseDepth[side] / weight[side]);
        pixel.variance = static_cast<float>(variance[side] / weight[side]);
    }
    return pixel;
}

TEST(VotePixels, PixelsGetTheDepthOfTheSurfaceOfSimilarColour) {
    const VoteRule rule{10, 12, 0.75F};
    for (const double invalid : {0.0, 0.5, 0.98, 1.0}) {
        const Scene scene(invalid);
        for (const PixelRect& where : {PixelRect{0, 0, 121, 93}, PixelRect{31, 22, 60, 50}}) {
            for (const int y : {where.y0, 45, where.y1 - 1}) {
                std::vector<OpenPixel> pixels;
                for (int x = where.x0; x < where.x1; x += 3)
                    pixels.push_back({x, static_cast<float>(x % 50), 30, 20});
                const std::vector<OpenPixel> before = pixels;
                votePixels(scene.voters(), rule, where, y, pixels);
                for (std::size_t i = 0; i < pixels.size(); ++i) {
                    double margin = 0;
                    const OpenPixel expected = decide(scene, rule, where, y, before[i], margin);
                    if (margin < 1e-3) continue;
                    ASSERT_EQ(pixels[i].decided, expected.decided) << pixels[i].x;
                    if (!expected.decided) continue;
                    ASSERT_NEAR(pixels[i].inverseDepth, expected.inverseDepth, 1e-5);
                    ASSERT_NEAR(pixels[i].variance, expected.variance, 1e-5);
                }
            }
        }
    }
}

}  // namespace
}  // namespace mfar::simd
