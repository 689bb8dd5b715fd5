#include "pipeline/epipolar/census.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mfar {
namespace {

constexpr int kRadius = simd::kCensusRadius, kSide = 2 * kRadius + 1;
// Number of pixels of a row, at both ends together, whose 5x5 neighbourhoods extend beyond the
// picture. Rows that are not longer than this are processed completely by censusAtEnd().
constexpr int kMostAtEnd = 2 * kRadius;

/// Computes the census of `count` pixels from pixel `first` on. Pixels beyond the ends of the rows
/// are taken from a copy that repeats the border pixels.
void censusAtEnd(const std::uint8_t* const (&rows)[kSide], int width, int first, int count,
                 const std::uint8_t* seen, std::uint32_t* out) {
    std::array<std::array<std::uint8_t, kMostAtEnd + 2 * kRadius>, kSide> padded{};
    const std::uint8_t* of[kSide];
    for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < count + 2 * kRadius; ++i)
            padded[j][i] = rows[j][std::clamp(first + i - kRadius, 0, width - 1)];
        of[j] = padded[j].data();
    }
    simd::censusRow(of, count, seen != nullptr ? seen + first : nullptr, out + first);
}

}  // namespace

void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out,
            const std::uint8_t* seen) {
    const auto [width, height] = picture.size;
    for (int y = first; y < last; ++y) {
        const std::uint8_t* rows[kSide];
        for (int j = 0; j < kSide; ++j)
            rows[j] = picture.row(std::clamp(y + j - kRadius, 0, height - 1));
        const std::size_t row = static_cast<std::size_t>(y) * width;
        const std::uint8_t* seenHere = seen != nullptr ? seen + row : nullptr;
        std::uint32_t* to = out.data() + row;
        if (width <= kMostAtEnd) {
            censusAtEnd(rows, width, 0, width, seenHere, to);
            continue;
        }
        censusAtEnd(rows, width, 0, kRadius, seenHere, to);
        simd::censusRow(rows, width - 2 * kRadius, seen != nullptr ? seenHere + kRadius : nullptr,
                        to + kRadius);
        censusAtEnd(rows, width, width - kRadius, kRadius, seenHere, to);
    }
}

}  // namespace mfar
