#pragma once

#include "base/geometry.h"
#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

/// 1 where inverse depth has an edge within some rows of ranges (rangeAlongRow()), or is not sound:
/// where the range is more than `jump` of the greatest, and `sigmas` standard deviations on top.
struct EdgeRule {
    float jump, sigmas;
};
void openRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows, const float* rho,
             const float* variance, std::size_t width, const EdgeRule& rule, std::uint8_t* out);

/// What every kVoterStep-th column and row of a picture votes for: inverse depth, below zero where
/// it has no vote, its variance, and the pixel's colour. Rows are followed by 64 readable bytes.
inline constexpr int kVoterStep = 2;
struct Voters {
    Rows<const float> rho, variance, red, green, blue;
};

/// A pixel of a row that is given the surface of those that look like it.
struct OpenPixel {
    int x = 0;
    float red = 0, green = 0, blue = 0;
    float rho = 0, variance = 0;  ///< the result, where it is decided
    bool decided = false;
};

struct VoteRule {
    int radius;         ///< of the voters' window [px]
    float likeness;     ///< difference in colour that counts half [grey levels]
    float leastWeight;  ///< of all voters, each at most one
};

/// Decides pixels of row y by their voters in `where`: the nearer or the farther half of what those
/// know, whichever looks more like the pixel.
void votePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels);

}  // namespace mfar::simd
