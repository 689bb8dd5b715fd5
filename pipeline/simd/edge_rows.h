#pragma once

#include "base/geometry.h"
#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

/// Writes 1 at pixels that are invalid or near an edge of inverse depth. At an edge, the range of
/// inverse depth exceeds `jump` times the largest value plus `sigmas` standard deviations. `low`,
/// `high`: rows of ranges along rows (rangeAlongRow()); the range is taken over `rows` of them.
struct EdgeRule {
    float jump, sigmas;
};
void openRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
             const float* inverseDepth, const float* variance, std::size_t width,
             const EdgeRule& rule, std::uint8_t* out);

/// Voters are every kVoterStep-th column and row of a picture. Each has its inverse depth
/// (negative: it does not vote), its variance, and the pixel's colour. 64 readable bytes follow
/// each row.
inline constexpr int kVoterStep = 2;
struct Voters {
    Rows<const float> inverseDepth, variance, red, green, blue;
};

/// A pixel whose depth is decided: it belongs to the surface whose voters have a similar colour.
struct OpenPixel {
    int x = 0;
    float red = 0, green = 0, blue = 0;
    float inverseDepth = 0, variance = 0;  ///< result, valid if `decided`
    bool decided = false;
};

struct VoteRule {
    int radius;         ///< radius of the voters' window [px]
    float likeness;     ///< colour difference at which a voter's weight is 1/2 [grey levels]
    float leastWeight;  ///< least sum of the voters' weights, each at most 1
};

/// Decides pixels of row y by the voters around them, within `where`. The voters are split into a
/// nearer and a farther half. The pixel takes the mean depth of the half with the larger sum of
/// weights.
void votePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels);

}  // namespace mfar::simd
