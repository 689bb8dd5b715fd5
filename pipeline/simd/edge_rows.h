#pragma once

#include "base/geometry.h"
#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

/// Parameters of openRow(), which finds the pixels whose depth is not reliable. It writes 1 at a
/// pixel without a valid depth or near a depth edge, else 0. A depth edge is near if largest -
/// smallest > jump * largest + sigmas * (the pixel's standard deviation), where `largest` and
/// `smallest` are the extreme inverse depths around the pixel. They are taken from `low` and
/// `high`, the results of rangeAlongRow() for `rows` consecutive rows, `pitch` entries apart.
struct EdgeRule {
    float jump, sigmas;
};
void openRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
             const float* inverseDepth, const float* variance, std::size_t width,
             const EdgeRule& rule, std::uint8_t* out);

/// Depth and colour of every kVoterStep-th pixel in every kVoterStep-th row. Around a depth edge,
/// votePixels() decides from these voters on which side a pixel lies. A voter with negative inverse
/// depth is ignored. 64 readable bytes follow each row.
inline constexpr int kVoterStep = 2;
struct Voters {
    Rows<const float> inverseDepth, variance, red, green, blue;
};

/// A pixel whose depth votePixels() decides, and its colour [grey levels].
struct OpenPixel {
    int x = 0;
    float red = 0, green = 0, blue = 0;
    float inverseDepth = 0, variance = 0;  ///< result; valid only if `decided` is true
    bool decided = false;
};

struct VoteRule {
    int radius;         ///< largest distance of a voter along each axis [px]
    float likeness;     ///< colour difference at which a voter's weight is 1/2 [grey levels]
    float leastWeight;  ///< a pixel is decided if a group of voters has at least this total weight
};

/// Decides the depth of pixels of row y. The voters of a pixel are those near it (VoteRule::radius)
/// and within `where`. The mean of their smallest and their largest inverse depth divides them into
/// a near and a far group. A voter's weight is 1 if its colour equals the pixel's colour, and falls
/// with the colour difference. The pixel gets the weighted mean inverse depth and variance of the
/// group with the larger total weight.
void votePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels);

}  // namespace mfar::simd
