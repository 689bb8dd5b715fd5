#include "pipeline/render/noise_filter.h"
#include "pipeline/render/rendered_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mfar {
namespace {

constexpr Size kNoisySize{40, 32};
constexpr float kSigma = 0.05F;

using Pixels = std::vector<LightPixel>;

template <class Value>
Pixels noisyPicture(Value value, float sigma = kSigma) {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, 1);
    Pixels out;
    for (int y = 0; y < kNoisySize.height; ++y)
        for (int x = 0; x < kNoisySize.width; ++x) {
            LightPixel p;
            p.first = Eigen::Array3f::Constant(value(x, y) + sigma * noise(random));
            p.second = Eigen::Array3f::Constant(value(x, y) + sigma * noise(random));
            p.firstVariance = p.secondVariance = kSigma * kSigma;
            p.firstCount = p.secondCount = 4;
            p.normal = {0, 0, -1};
            p.depth = 1;
            p.id = 1;
            out.push_back(p);
        }
    return out;
}

template <class Value>
double errorOf(const Pixels& pixels, Value value) {
    double squares = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const float wanted =
            value(static_cast<int>(i % kNoisySize.width), static_cast<int>(i / kNoisySize.width));
        for (const float found : {pixels[i].first[0], pixels[i].second[0]})
            squares += (found - wanted) * (found - wanted);
    }
    return std::sqrt(squares / static_cast<double>(2 * pixels.size()));
}

constexpr double kFocal = 560;  // [px]

/// Runs each stage in several portions, the last rows first.
Pixels filtered(Size size, const Pixels& pixels, double focal = kFocal) {
    NoiseFilter filter;
    filter.begin(size, {0, 0, size.width, size.height}, focal);
    std::ranges::copy(pixels, filter.pixels().begin());
    for (int stage = 0; stage < NoiseFilter::kStages; ++stage)
        for (const int row : {5, 2, 0})
            filter.run(stage, row, row == 5 ? size.height : row == 2 ? 5 : 2);
    return {filter.filtered().begin(), filter.filtered().end()};
}

float flat(int, int) {
    return 0.5F;
}
float step(int x, int) {
    return x < kNoisySize.width / 2 ? 0.4F : 0.5F;
}

TEST(NoiseFilter, SmoothsNoise) {
    Pixels pixels = noisyPicture(flat);
    pixels = filtered(kNoisySize, pixels);
    EXPECT_LT(errorOf(pixels, flat), kSigma / 2);
}

TEST(NoiseFilter, SmoothsAFloorAlsoWhereItsPixelsAreLarge) {
    Pixels pixels = noisyPicture(flat);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const std::size_t row = i / kNoisySize.width;
        pixels[i].id = kCatcherId;
        pixels[i].depth = std::exp(0.02F * static_cast<float>(row));
    }
    const double alongRows = errorOf(filtered(kNoisySize, pixels), flat);
    const double everywhere = errorOf(filtered(kNoisySize, pixels, kFocal / 8), flat);
    EXPECT_LT(everywhere, kSigma / 2);
    EXPECT_LT(everywhere, 0.7 * alongRows);
}

TEST(NoiseFilter, EstimatesUnknownVariances) {
    Pixels pixels = noisyPicture(flat);
    for (LightPixel& p : pixels)
        p.firstVariance = p.secondVariance = -1;
    pixels = filtered(kNoisySize, pixels);
    EXPECT_LT(errorOf(pixels, flat), kSigma / 2);
}

/// Returns the error of a filtered soft shadow. A quarter of the pixels has `samples` samples each;
/// the others have none. In a single sample, objects block all of the light or none. So single
/// pixels look like spots until the filter averages them with their neighbours.
double spotsOf(std::uint8_t id, int samples, std::uint32_t seed) {
    constexpr double kBlocked = 0.25;
    std::mt19937 random(seed);
    std::bernoulli_distribution isBlocked(kBlocked);
    Pixels pixels = noisyPicture(flat);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        LightPixel& p = pixels[i];
        const bool isSampled = i % kNoisySize.width % 2 == 0 && i / kNoisySize.width % 2 == 0;
        const auto n = static_cast<float>(samples);
        float share = 0;
        for (int k = 0; isSampled && k < samples; ++k)
            share += isBlocked(random) ? 1 / n : 0;
        p.first = p.second = Eigen::Array3f::Constant(-share);
        p.firstVariance = p.secondVariance =
            n < LightPixel::kFew ? -1 : share * (1 - share) / (n - 1);
        p.firstCount = p.secondCount = isSampled ? n : 0;
        p.id = id;
    }
    return errorOf(filtered(kNoisySize, pixels), [&](int, int) { return -kBlocked; });
}

double meanSpotsOf(std::uint8_t id, int samples) {
    constexpr std::uint32_t kSeeds = 10;
    double sum = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed)
        sum += spotsOf(id, samples, seed) / kSeeds;
    return sum;
}

TEST(NoiseFilter, SamplesOfASoftShadowLeaveFewerSpotsOnTheCatcherThanOnObjects) {
    for (const int samples : {1, 4, 16})
        EXPECT_LT(meanSpotsOf(kCatcherId, samples), 0.8 * meanSpotsOf(1, samples)) << samples;
}

// From LightPixel::kFew samples on, the variance is estimated from the pixel's own samples. It is
// too low if they all agree by chance.
TEST(NoiseFilter, MoreSamplesOfASoftShadowHardlyIncreaseTheSpots) {
    static_assert(LightPixel::kFew == 4);
    EXPECT_LT(meanSpotsOf(kCatcherId, 2), meanSpotsOf(kCatcherId, 1));
    EXPECT_LT(meanSpotsOf(kCatcherId, 4), 1.05 * meanSpotsOf(kCatcherId, 2));
    EXPECT_LT(meanSpotsOf(kCatcherId, 16), meanSpotsOf(kCatcherId, 4));
}

// Filters a picture whose light is 0.5 except in the bright middle pixel, and returns this pixel.
// `variance` is that of the bright pixel if it has at least LightPixel::kFew samples.
LightPixel brightPixelFiltered(float samples, std::uint8_t id, float variance = 1e-6F) {
    Pixels pixels = noisyPicture(flat, 0);
    for (LightPixel& p : pixels) {
        p.firstVariance = p.secondVariance = samples < LightPixel::kFew ? -1 : 1e-6F;
        p.firstCount = p.secondCount = samples;
        p.id = id;
    }
    const std::size_t middle = 16 * kNoisySize.width + 20;
    pixels[middle].first = pixels[middle].second = Eigen::Array3f(10, 5, 5);
    if (samples >= LightPixel::kFew)
        pixels[middle].firstVariance = pixels[middle].secondVariance = variance;
    return filtered(kNoisySize, pixels)[middle];
}

TEST(NoiseFilter, ABrightPixelIsLimitedToItsNeighboursIfNoiseExplainsIt) {
    const LightPixel few = brightPixelFiltered(1, 1), many = brightPixelFiltered(64, 1, 25);
    for (const Eigen::Array3f& light : {few.first, few.second, many.first, many.second})
        EXPECT_NEAR(0.2126F * light[0] + 0.7152F * light[1] + 0.0722F * light[2], 0.5F, 0.02F);
}

TEST(NoiseFilter, ABrightPixelStaysBrightIfNoiseDoesNotExplainIt) {
    const LightPixel found = brightPixelFiltered(10, 1);
    EXPECT_NEAR(found.first[0], 10, 0.1F);
    EXPECT_NEAR(found.second[1], 5, 0.1F);
}

TEST(NoiseFilter, BrightPixelsOfTheShadowCatcherAreNotLimited) {
    EXPECT_GT(brightPixelFiltered(1, kCatcherId).first[0], 0.8F);
}

TEST(NoiseFilter, KeepsDifferencesAboveNoise) {
    const auto edge = [](int x, int) { return x < kNoisySize.width / 2 ? 0.1F : 0.9F; };
    Pixels pixels = noisyPicture(edge);
    pixels = filtered(kNoisySize, pixels);
    EXPECT_LT(errorOf(pixels, edge), kSigma / 2);
    Pixels known = noisyPicture(flat);
    for (LightPixel& p : known)
        p.firstVariance = p.secondVariance = 0;
    known = filtered(kNoisySize, known);
    EXPECT_GT(errorOf(known, flat), 0.95 * kSigma);
}

// Returns the error after filtering a picture whose halves differ by two standard errors. From the
// light alone, this step looks like noise. `mark` can give the halves different ids, depths or
// normals.
template <class Mark>
double errorAtStep(Mark mark) {
    Pixels pixels = noisyPicture(step, 0);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        mark(pixels[i], static_cast<int>(i % kNoisySize.width) < kNoisySize.width / 2);
    pixels = filtered(kNoisySize, pixels);
    return errorOf(pixels, step);
}

TEST(NoiseFilter, DoesNotMixDifferentSurfaces) {
    EXPECT_GT(errorAtStep([](LightPixel&, bool) {}), 1e-3);
    EXPECT_LT(errorAtStep([](LightPixel& p, bool left) { p.id = left ? 1 : 2; }), 1e-6);
    EXPECT_LT(errorAtStep([](LightPixel& p, bool left) { p.depth = left ? 1.0F : 1.2F; }), 1e-6);
    EXPECT_LT(errorAtStep([](LightPixel& p, bool left) {
                  p.normal = left ? Eigen::Array3f(0, 0, -1) : Eigen::Array3f(1, 0, 0);
              }),
              1e-6);
}

TEST(NoiseFilter, KeptPixelsAndPixelsWithoutSurfaceStayUnchanged) {
    Pixels pixels = noisyPicture(flat);
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        pixels[i].id = i % 2 == 0 ? 0 : 1;
        pixels[i].kept = pixels[i].id == 1;
    }
    const Pixels before = pixels;
    pixels = filtered(kNoisySize, pixels);
    for (std::size_t i = 0; i < pixels.size(); i += 3)
        ASSERT_TRUE((pixels[i].first == before[i].first).all() &&
                    (pixels[i].second == before[i].second).all())
            << i;
}

// The light has two parts. One pixel in 16 has samples of the first part, one in 64 of the second.
TEST(NoiseFilter, FillsPixelsWithoutSamples) {
    Pixels pixels = noisyPicture(flat, 0);
    for (int y = 0; y < kNoisySize.height; ++y)
        for (int x = 0; x < kNoisySize.width; ++x) {
            LightPixel& p = pixels[static_cast<std::size_t>(y) * kNoisySize.width + x];
            p.firstVariance = p.secondVariance = -1;
            if (x % 4 != 0 || y % 4 != 0) {
                p.first.setZero();
                p.firstCount = 0;
            }
            if (x % 8 != 0 || y % 8 != 0) {
                p.second.setZero();
                p.secondCount = 0;
            }
        }
    pixels = filtered(kNoisySize, pixels);
    EXPECT_LT(errorOf(pixels, flat), 1e-5);
    for (const LightPixel& p : pixels)
        ASSERT_TRUE(p.firstCount > 0 && p.secondCount > 0);
}

// One part of the light differs between neighbours by more than noise. The other part must still be
// filtered.
TEST(NoiseFilter, FiltersBothLightPartsSeparately) {
    Pixels pixels = noisyPicture(flat);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i].second.setConstant(static_cast<int>(i % kNoisySize.width) < 20 ? 0.1F : 0.9F);
    const Pixels before = pixels;
    pixels = filtered(kNoisySize, pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        ASSERT_NEAR(pixels[i].second[0], before[i].second[0], 1e-5F);
        pixels[i].second.setConstant(0.5F);
    }
    EXPECT_LT(errorOf(pixels, flat), kSigma / 2);
}

TEST(NoiseFilter, ReadsNothingOutsideTheGivenRectangle) {
    const PixelRect where{8, 4, 30, 20};
    const auto isInside = [&](std::size_t i) {
        const int x = static_cast<int>(i) % kNoisySize.width;
        const int y = static_cast<int>(i) / kNoisySize.width;
        return x >= where.x0 && x < where.x1 && y >= where.y0 && y < where.y1;
    };
    const auto filteredWith = [&](float outside, bool varianceIsKnown) {
        NoiseFilter filter;
        filter.begin(kNoisySize, where, kFocal);
        std::ranges::copy(noisyPicture(flat), filter.pixels().begin());
        for (std::size_t i = 0; i < filter.pixels().size(); ++i) {
            LightPixel& p = filter.pixels()[i];
            if (!varianceIsKnown) p.firstVariance = p.secondVariance = -1;
            if (isInside(i)) continue;
            p.first.setConstant(outside);
            p.second.setConstant(outside);
            p.firstVariance = p.secondVariance = outside;
        }
        for (int stage = 0; stage < NoiseFilter::kStages; ++stage)
            filter.run(stage, 0, kNoisySize.height);
        Pixels out;
        for (std::size_t i = 0; i < filter.pixels().size(); ++i)
            if (isInside(i)) out.push_back(filter.filtered()[i]);
        return out;
    };
    for (const bool varianceIsKnown : {true, false}) {
        const Pixels some = filteredWith(0.5F, varianceIsKnown);
        const Pixels others = filteredWith(1e6F, varianceIsKnown);
        ASSERT_EQ(some.size(), 22U * 16);
        for (std::size_t i = 0; i < some.size(); ++i) {
            ASSERT_EQ(some[i].first[0], others[i].first[0]) << i;
            ASSERT_EQ(some[i].second[0], others[i].second[0]) << i;
        }
    }
}

TEST(NoiseFilter, WorksForPicturesOfAnySize) {
    for (const Size size : {Size{0, 0}, Size{1, 1}, Size{1, 9}, Size{9, 1}}) {
        Pixels pixels(static_cast<std::size_t>(size.width) * size.height);
        for (LightPixel& p : pixels) {
            p.first.setConstant(0.5F);
            p.firstVariance = p.secondVariance = -1;
            p.firstCount = 1;
            p.id = 1;
        }
        pixels = filtered(size, pixels);
        for (const LightPixel& p : pixels)
            ASSERT_NEAR(p.first[2], 0.5F, 1e-6);
    }
}

}  // namespace
}  // namespace mfar
