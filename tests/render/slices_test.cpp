#include "pipeline/slices/slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using Pixels = std::vector<std::uint32_t>;

constexpr Size kPicture{37, 29};
constexpr PixelRect kBounds{3, 5, 30, 28};

/// The error of a pixel is its own noise divided by the root of its number of samples.
class NoisyPicture {
public:
    explicit NoisyPicture(std::function<float(std::uint32_t)> noise) : noise_(std::move(noise)) {}

    void trace(const Slice& slice) {
        for (const std::uint32_t pixel : slice.pixels)
            samples_[pixel] += slice.samples;
    }
    [[nodiscard]] PixelState state(std::uint32_t pixel) const {
        const auto found = samples_.find(pixel);
        const auto samples = static_cast<float>(found == samples_.end() ? 0 : found->second);
        if (!(samples > 0)) return {std::numeric_limits<float>::infinity(), 0};
        return {noise_(pixel) / std::sqrt(samples), samples};
    }
    [[nodiscard]] const std::map<std::uint32_t, int>& samples() const { return samples_; }

private:
    std::function<float(std::uint32_t)> noise_;
    std::map<std::uint32_t, int> samples_;
};

float hashedNoise(std::uint32_t pixel) {
    const int row = static_cast<int>(pixel) / kPicture.width;
    return 0.02F * static_cast<float>(row) * static_cast<float>(pixel * 2654435761U >> 28);
}

/// Traces until no portion is left. Up to `workers` portions of at most `most` samples are traced
/// at a time and finished in random order.
void traceAll(Slices& slices, NoisyPicture& picture, std::size_t workers, std::int64_t most) {
    std::mt19937 random(7);
    std::vector<Slice> out;
    const auto states = [&](std::uint32_t pixel) { return picture.state(pixel); };
    while (true) {
        while (out.size() < workers) {
            const Slice slice = slices.next(most);
            if (slice.pixels.empty()) break;
            out.push_back(slice);
        }
        if (out.empty()) return;
        std::swap(out[random() % out.size()], out.back());
        picture.trace(out.back());
        slices.done(out.back(), states);
        out.pop_back();
    }
}

NoisyPicture traced(const SliceOptions& options, std::size_t workers, std::int64_t most) {
    NoisyPicture picture(hashedNoise);
    Slices slices(options);
    slices.begin(kBounds, kPicture);
    traceAll(slices, picture, workers, most);
    EXPECT_TRUE(slices.finished());
    EXPECT_TRUE(slices.turnComplete());
    EXPECT_EQ(slices.samples(), options.samples);
    EXPECT_DOUBLE_EQ(slices.progress(), 1);
    return picture;
}

TEST(Slices, EveryPixelWithinTheBoundsGetsTheConfiguredSamples) {
    for (const Slicing slicing : {Slicing::Time, Slicing::Spatial}) {
        const NoisyPicture picture = traced({slicing, 10, 3, 0, 2}, 3, 50);
        EXPECT_EQ(picture.samples().size(), 27U * 23U);
        for (const auto& [pixel, samples] : picture.samples()) {
            const int x = static_cast<int>(pixel) % kPicture.width;
            const int y = static_cast<int>(pixel) / kPicture.width;
            EXPECT_TRUE(x >= 3 && x < 30 && y >= 5 && y < 28) << x << ' ' << y;
            EXPECT_EQ(samples, 10);
        }
    }
}

TEST(Slices, EveryPixelOfALargePictureIsTracedOnce) {
    constexpr Size kLarge{2400, 2400};
    for (const PixelRect& bounds : {PixelRect{2030, 3, 2390, 9}, PixelRect{3, 2030, 9, 2390}}) {
        Slices slices({Slicing::Time, 1, 1, 0, 2});
        slices.begin(bounds, kLarge);
        NoisyPicture picture([](std::uint32_t) { return 0.0F; });
        traceAll(slices, picture, 1, 1000);
        EXPECT_EQ(picture.samples().size(), 360U * 6U);
        for (const auto& [pixel, samples] : picture.samples()) {
            const int x = static_cast<int>(pixel) % kLarge.width;
            const int y = static_cast<int>(pixel) / kLarge.width;
            ASSERT_TRUE(x >= bounds.x0 && x < bounds.x1 && y >= bounds.y0 && y < bounds.y1)
                << x << ' ' << y;
            ASSERT_EQ(samples, 1) << x << ' ' << y;
        }
    }
}

TEST(Slices, NumbersOfSamplesDoNotDependOnSlicingOrThreads) {
    const SliceOptions time{Slicing::Time, 64, 4, 1, 8};
    SliceOptions spatial = time;
    spatial.slicing = Slicing::Spatial;
    const auto truth = traced(time, 1, 1 << 20).samples();
    const auto [least, most] = std::ranges::minmax_element(
        truth, {}, [](const auto& pixelAndSamples) { return pixelAndSamples.second; });
    EXPECT_LT(least->second, most->second)
        << "the numbers of samples do not differ, so this picture tests no adaptivity";
    for (const std::size_t workers : {1U, 2U, 5U})
        for (const std::int64_t portion : {1, 40, 1000}) {
            EXPECT_EQ(traced(time, workers, portion).samples(), truth);
            EXPECT_EQ(traced(spatial, workers, portion).samples(), truth);
        }
}

TEST(Slices, NoPixelIsInTwoUnfinishedPortions) {
    for (const Slicing slicing : {Slicing::Time, Slicing::Spatial}) {
        Slices slices({slicing, 16, 4, 0, 2});
        slices.begin(kBounds, kPicture);
        std::deque<Slice> out;
        std::multiset<std::uint32_t> pixels;
        for (int i = 0; i < 2000; ++i) {
            const Slice slice = slices.next(i % 70);
            for (const std::uint32_t pixel : slice.pixels)
                EXPECT_EQ(pixels.count(pixel), 0U);
            pixels.insert(slice.pixels.begin(), slice.pixels.end());
            if (!slice.pixels.empty()) out.push_back(slice);
            if (out.empty()) break;
            if (out.size() < 4 && !slice.pixels.empty()) continue;
            for (const std::uint32_t pixel : out.front().pixels)
                pixels.erase(pixel);
            slices.done(out.front(), [](std::uint32_t) { return PixelState{}; });
            out.pop_front();
        }
        EXPECT_TRUE(slices.finished());
    }
}

// A turn visits each pixel at most once. The first turn traces a ray through every pixel's centre.
// The next three take the first samples: in one pixel of 16, in one of 4, and in all.
TEST(Slices, AllPixelsHaveEqualSamplesAfterEachFullTurnOfTimeSlices) {
    Slices slices({Slicing::Time, 8, 3, 0, 2});
    slices.begin({0, 0, 32, 24}, {32, 24});
    NoisyPicture picture([](std::uint32_t) { return 1.0F; });
    std::vector<int> turns, sampled;
    while (true) {
        const Slice slice = slices.next(100);
        if (slice.pixels.empty()) break;
        EXPECT_FALSE(slices.turnComplete());
        EXPECT_EQ(slice.samples == 0, turns.empty())
            << "only the first turn traces rays without samples";
        picture.trace(slice);
        slices.done(slice, [](std::uint32_t) { return PixelState{1}; });
        if (!slices.turnComplete()) continue;
        turns.push_back(slices.samples());
        EXPECT_EQ(slices.turns(), static_cast<int>(turns.size()));
        const auto isSampled = [](const auto& pixel) { return pixel.second > 0; };
        sampled.push_back(static_cast<int>(std::ranges::count_if(picture.samples(), isSampled)));
        EXPECT_EQ(picture.samples().size(), slices.pixels())
            << "the first turn must trace every pixel";
        if (turns.back() == 0) continue;
        for (const auto& [pixel, samples] : picture.samples())
            EXPECT_EQ(samples, turns.back()) << pixel;
    }
    EXPECT_EQ(turns, (std::vector<int>{0, 0, 0, 3, 6, 8}));
    EXPECT_EQ(sampled, (std::vector<int>{0, 48, 192, 768, 768, 768}));
}

TEST(Slices, FirstSamplesAreEvenlySpread) {
    Slices slices({Slicing::Time, 2, 1, 0, 2});
    slices.begin({0, 0, 32, 24}, {32, 24});
    NoisyPicture picture([](std::uint32_t) { return 1.0F; });
    for (int edge = 8; edge > 1; edge /= 2) {
        std::set<std::pair<int, int>> blocks;
        do {
            const Slice slice = slices.next(100);
            picture.trace(slice);
            slices.done(slice, [](std::uint32_t) { return PixelState{1}; });
        } while (!slices.turnComplete());
        for (const auto& [pixel, samples] : picture.samples())
            if (samples > 0)
                blocks.emplace(static_cast<int>(pixel) % 32 / edge,
                               static_cast<int>(pixel) / 32 / edge);
        if (edge < 8) {
            EXPECT_EQ(static_cast<int>(blocks.size()), 32 * 24 / (edge * edge)) << edge;
        }
    }
}

TEST(Slices, PixelsWithLittleNoiseFromTheStartGetNoSamples) {
    Slices slices({Slicing::Time, 16, 4, 1, 8});
    slices.begin({0, 0, 32, 24}, {32, 24});
    NoisyPicture picture([](std::uint32_t) { return 1e6F; });
    // Pixels in the left half have little noise from the start, as if they reused earlier light.
    while (true) {
        const Slice slice = slices.next(50);
        if (slice.pixels.empty()) break;
        picture.trace(slice);
        slices.done(slice, [&](std::uint32_t pixel) {
            return pixel % 32 < 16 ? PixelState{0.1F, 64} : picture.state(pixel);
        });
    }
    for (const auto& [pixel, samples] : picture.samples())
        EXPECT_EQ(samples, pixel % 32 < 16 ? 0 : 16) << pixel;
}

TEST(Slices, TilesWithoutObjectsGetOnlyTheSparseSamples) {
    Slices slices({Slicing::Time, 16, 4, 1, 8});
    slices.begin({0, 0, 32, 24}, {32, 24});
    NoisyPicture picture([](std::uint32_t) { return 1e6F; });
    while (true) {
        const Slice slice = slices.next(50);
        if (slice.pixels.empty()) break;
        picture.trace(slice);
        slices.done(slice, [&](std::uint32_t pixel) {
            PixelState state = picture.state(pixel);
            state.untouched = pixel % 32 < 16;
            return state;
        });
    }
    int sampled = 0;
    for (const auto& [pixel, samples] : picture.samples()) {
        if (pixel % 32 < 16)
            sampled += samples > 0 ? 1 : 0;
        else
            EXPECT_EQ(samples, 16) << pixel;
    }
    EXPECT_EQ(sampled, 16 * 24 / 4);
    EXPECT_DOUBLE_EQ(slices.progress(), 1);
}

TEST(Slices, DensityNoneSamplesNoPixelAndDensityQuarterEveryFourth) {
    Slices slices({Slicing::Time, 4, 2, 0, 2});
    slices.begin({0, 0, 24, 8}, {24, 8}, [](const PixelRect& tile) {
        if (tile.x0 == 0) return Slices::Density::None;
        return tile.x0 == 8 ? Slices::Density::Quarter : Slices::Density::Full;
    });
    NoisyPicture picture([](std::uint32_t) { return 1.0F; });
    traceAll(slices, picture, 2, 10);
    EXPECT_EQ(picture.samples().size(), 16U + 64U);
    for (const auto& [pixel, samples] : picture.samples()) {
        const auto x = pixel % 24, y = pixel / 24;
        EXPECT_TRUE(x >= 16 || (x >= 8 && x % 2 == 0 && y % 2 == 0)) << x << ' ' << y;
        EXPECT_EQ(samples, 4);
    }
}

TEST(Slices, SpatialSlicesFinishTileAfterTile) {
    Slices slices({Slicing::Spatial, 16, 4, 0, 2});
    slices.begin({0, 0, 32, 32}, {32, 32});
    std::vector<std::uint32_t> tiles;
    std::set<std::uint32_t> pixels;
    for (Slice slice = slices.next(1000); !slice.pixels.empty(); slice = slices.next(1000)) {
        if (tiles.empty() || tiles.back() != slice.tile) tiles.push_back(slice.tile);
        pixels.insert(slice.pixels.begin(), slice.pixels.end());
        if (tiles.size() == 1) {
            EXPECT_LE(pixels.size(), 64U);
        }
        EXPECT_EQ(slices.samples(), 0);
        slices.done(slice, [](std::uint32_t) { return PixelState{1}; });
    }
    EXPECT_EQ(tiles.size(), 16U) << "another tile was begun before a tile was finished";
    EXPECT_EQ(slices.samples(), 16);
}

TEST(Slices, TilesFollowTheMortonCurve) {
    Slices slices({Slicing::Time, 1, 1, 0, 2});
    slices.begin({0, 0, 32, 32}, {32, 32});
    std::vector<std::pair<int, int>> places;
    do {
        const Slice slice = slices.next(64);
        const int first = static_cast<int>(slice.pixels.front());
        places.emplace_back(first % 32 / 8, first / 32 / 8);
        slices.done(slice, [](std::uint32_t) { return PixelState{1}; });
    } while (!slices.turnComplete());
    const std::vector<std::pair<int, int>> curve{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 0}, {3, 0}};
    ASSERT_EQ(places.size(), 16U);
    EXPECT_TRUE(std::equal(curve.begin(), curve.end(), places.begin()));
    EXPECT_EQ(places.back(), std::pair(3, 3));
}

TEST(Slices, OnlyNoisyPixelsAndTheirNeighboursGetAllSamples) {
    // Only one pixel in the middle of a tile is noisy. It and its neighbours must get more samples.
    const std::uint32_t noisy = 12 * 32 + 12;
    NoisyPicture picture([&](std::uint32_t pixel) { return pixel == noisy ? 1e6F : 0.1F; });
    Slices slices({Slicing::Time, 64, 4, 1, 8});
    slices.begin({0, 0, 32, 32}, {32, 32});
    traceAll(slices, picture, 2, 100);
    int many = 0;
    for (const auto& [pixel, samples] : picture.samples()) {
        const int x = static_cast<int>(pixel) % 32, y = static_cast<int>(pixel) / 32;
        const bool near = std::abs(x - 12) <= 1 && std::abs(y - 12) <= 1;
        EXPECT_EQ(samples, near ? 64 : 8) << x << ' ' << y;
        many += samples == 64 ? 1 : 0;
    }
    EXPECT_EQ(many, 9);
}

TEST(Slices, PixelWithANanErrorGetsMoreSamples) {
    Slices slices({Slicing::Spatial, 32, 4, 1, 4});
    slices.begin({0, 0, 8, 8}, {8, 8});
    const auto states = [](std::uint32_t) {
        return PixelState{std::numeric_limits<float>::quiet_NaN(), 32};
    };
    for (Slice slice = slices.next(1000); !slice.pixels.empty(); slice = slices.next(1000))
        slices.done(slice, states);
    EXPECT_EQ(slices.traced(), 64U * 32U);
}

TEST(Slices, EmptyBoundsAreFinishedAtOnce) {
    Slices slices({});
    EXPECT_TRUE(slices.finished());
    for (const PixelRect& nothing :
         {PixelRect{}, PixelRect{40, 2, 50, 9}, PixelRect{-9, -9, 0, 4}}) {
        slices.begin(nothing, kPicture);
        EXPECT_TRUE(slices.finished());
        EXPECT_TRUE(slices.next(100).pixels.empty());
        EXPECT_DOUBLE_EQ(slices.progress(), 1);
    }
}

TEST(Slices, NewPictureStartsWithoutThePreviousState) {
    Slices slices({Slicing::Spatial, 4, 2, 0, 2});
    slices.begin(kBounds, kPicture);
    const Slice slice = slices.next(10);
    slices.done(slice, [](std::uint32_t) { return PixelState{}; });
    slices.begin({0, 0, 8, 8}, {8, 8});
    NoisyPicture picture(hashedNoise);
    traceAll(slices, picture, 1, 100);
    EXPECT_EQ(slices.traced(), 64U * 4U);
    EXPECT_EQ(picture.samples().size(), 64U);
}

TEST(Slices, OptionsOutOfRangeAreRefused) {
    EXPECT_THROW(Slices({Slicing::Time, 0}), std::invalid_argument);
    EXPECT_THROW(Slices({Slicing::Time, 4, 0}), std::invalid_argument);
    EXPECT_THROW(Slices({Slicing::Time, 4, 1, -1}), std::invalid_argument);
    EXPECT_THROW(Slices({Slicing::Time, 4, 1, std::nanf("")}), std::invalid_argument);
    EXPECT_THROW(Slices({Slicing::Time, 4, 1, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace mfar
