#include "base/rows.h"
#include "pipeline/simd/detail_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace mfar::simd {
namespace {

constexpr Size kStill{311, 90};
constexpr int kPixels = 300;

/// A still of noise: if warpRow() reads a wrong pixel, the result almost always differs.
AlignedRows<std::uint16_t> noisePairs() {
    AlignedRows<std::uint16_t> out({kStill.width + 64, kStill.height});
    std::mt19937 random(3);
    std::vector<std::uint8_t> grey(static_cast<std::size_t>(kStill.width) * (kStill.height + 1));
    std::ranges::generate(grey, [&] { return static_cast<std::uint8_t>(random() & 255); });
    for (int y = 0; y < kStill.height; ++y)
        for (int x = 0; x < kStill.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * kStill.width + x;
            out[y][x] = static_cast<std::uint16_t>(grey[at] | grey[at + kStill.width] << 8);
        }
    return out;
}

struct Place {
    double x, y;
};
using PlaceOf = std::function<Place(int)>;

double luma(const AlignedRows<std::uint16_t>& still, const Place& place) {
    const double x = std::clamp(place.x, 0.0, kStill.width - 1.0),
                 y = std::clamp(place.y, 0.0, kStill.height - 1.0);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const auto mixed = [&](int pair) {
        return std::lerp(double(pair & 255), double(pair >> 8), y - row);
    };
    return std::lerp(mixed(still[row][column]), mixed(still[row][column + 1]), x - column);
}

/// Expects that warpRow() returns the still's luma at the positions of `placeOf`. Their y must be
/// multiples of 1/256, to which warpRow() rounds y.
void expectPixelsOf(const std::string& name, const PlaceOf& placeOf) {
    const AlignedRows<std::uint16_t> still = noisePairs();
    AlignedRows<float> places({kPixels + 64, 2});
    AlignedRows<float> none({kPixels + 64, 1});
    for (int i = 0; i < kPixels; ++i) {
        const Place place = placeOf(i);
        places[0][i] = static_cast<float>(place.x - i);
        places[1][i] = static_cast<float>(place.y);
    }
    AlignedRows<std::int16_t> out({kPixels + 64, 1});
    const LookUpRows rows{
        {places[0], places[0]}, {places[1], places[1]}, {none[0], none[0]}, 0, 1, 0, 0};
    warpRow({still[0], still.pitch(), kStill}, rows, 3, kPixels, out[0]);
    for (int i = 3; i < kPixels; ++i)
        ASSERT_NEAR(out[0][i], 32 * luma(still, placeOf(i)), 1) << name << ": pixel " << i;
}

TEST(WarpRow, TheStillIsInterpolatedAtRegularAndIrregularPositions) {
    expectPixelsOf("all positions in one row of the still",
                   [](int i) { return Place{i + 0.25, 7.5}; });
    expectPixelsOf("y changes slowly", [](int i) { return Place{i + 0.75, 3.25 + i / 16.0}; });
    expectPixelsOf("y changes quickly", [](int i) { return Place{i + 0.75, 80.25 - i / 4.0}; });
    expectPixelsOf("steps of 1.25 px", [](int i) { return Place{1.25 * i, 20 + i / 32.0}; });
    expectPixelsOf("steps of 2 px", [](int i) { return Place{2.0 * i - 100, 20.5}; });
    expectPixelsOf("steps of 2.5 px", [](int i) { return Place{2.5 * i - 200, 20.5}; });
    expectPixelsOf("from right to left", [](int i) { return Place{kPixels - i + 0.5, 20.5}; });
    expectPixelsOf("jumps of 40 px, as at edges between surfaces",
                   [](int i) { return Place{i + (i / 9 % 2) * 40 + 0.5, 20.0 + i / 7 % 3}; });
    expectPixelsOf("positions beyond the still's borders",
                   [](int i) { return Place{1.5 * i - 60, i - 40.0}; });
}

}  // namespace
}  // namespace mfar::simd
