#pragma once

#include "base/geometry.h"
#include "base/rows.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

/// openRow() writes 1 at pixels that are invalid or near an edge of inverse depth, else 0. A pixel
/// is near an edge if the largest minus the smallest inverse depth around it exceeds `jump` times
/// the largest plus `sigmas` standard deviations. `low`, `high`: results of rangeAlongRow() for
/// `rows` consecutive rows, which are `pitch` entries apart.
struct EdgeRule {
    float jump, sigmas;
};
void openRow(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
             const float* inverseDepth, const float* variance, std::size_t width,
             const EdgeRule& rule, std::uint8_t* out);

/// Voters are the pixels in every kVoterStep-th column and row. A pixel with negative inverse depth
/// does not vote. 64 readable bytes follow each row.
inline constexpr int kVoterStep = 2;
struct Voters {
    Rows<const float> inverseDepth, variance, red, green, blue;
};

/// A pixel whose depth votePixels() decides. It belongs to the surface whose voters have a similar
/// colour.
struct OpenPixel {
    int x = 0;
    float red = 0, green = 0, blue = 0;
    float inverseDepth = 0, variance = 0;  ///< result, valid if `decided`
    bool decided = false;
};

struct VoteRule {
    int radius;         ///< radius of the voters' window [px]
    float likeness;     ///< colour difference at which a voter's weight is 1/2 [grey levels]
    float leastWeight;  ///< smallest sum of weights that decides a pixel; a weight is at most 1
};

/// Decides the depth of pixels of row y from the voters around them within `where`. The voters form
/// a near and a far group, split at the middle of their range of inverse depth. The pixel takes the
/// mean inverse depth of the group with the larger sum of weights.
void votePixels(const Voters& voters, const VoteRule& rule, const PixelRect& where, int y,
                std::span<OpenPixel> pixels);

}  // namespace mfar::simd
