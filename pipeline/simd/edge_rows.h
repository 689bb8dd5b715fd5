#pragma once

#include "base/geometry.h"
#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

/// Writes 1 where inverse depth has an edge within some rows of ranges (rangeAlongRow()) or is
/// invalid. An edge: the range is more than `jump` times the largest value, plus `sigmas` standard
/// deviations.
struct EdgeRule {
    float jump, sigmas;
};
void openRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows, const float* rho,
             const float* variance, std::size_t width, const EdgeRule& rule, std::uint8_t* out);

/// Votes at every kVoterStep-th column and row of a picture: inverse depth (negative: no vote), its
/// variance, and the pixel's colour. 64 readable bytes follow each row.
inline constexpr int kVoterStep = 2;
struct Voters {
    Rows<const float> rho, variance, red, green, blue;
};

/// A pixel of a row that is assigned to the surface whose voters resemble it.
struct OpenPixel {
    int x = 0;
    float red = 0, green = 0, blue = 0;
    float rho = 0, variance = 0;  ///< the result, valid if `decided`
    bool decided = false;
};

struct VoteRule {
    int radius;         ///< of the voters' window [px]
    float likeness;     ///< difference in colour at which a voter has half its weight [grey levels]
    float leastWeight;  ///< lower limit of the sum of the voters' weights, each at most 1
};

/// Decides pixels of row y by their voters in `where`. The voters are split into a nearer and a
/// farther half; the pixel gets the half that resembles it more.
void votePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels);

}  // namespace mfar::simd
