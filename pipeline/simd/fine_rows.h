#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/simd/cell_weights.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

// Rows of cells of 4x4 video pixels, read and written in vectors of up to 16 cells.

/// How the finest detail of the video and of a still vary in cells: mean products of what pixels
/// differ from the mean of their block of 2x2 [grey levels^2].
struct FineSums {
    float *video, *both, *still;
};

/// Of the middle two rows of pixels of a row of cells. `video` [1/8 grey level]. `still`: 2x2
/// samples a pixel, two rows of them for each of the video's [1/32 grey level]; becomes scratch.
void fineSumsRow(const std::array<const std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end, const FineSums& to);

struct FineSumsAround {
    RowsAround video, both, still;
};

/// Share of their weight that cells keep, from the sums of 3x3 cells: see params::kFineRoom.
void fineShareRow(const FineSumsAround& sums, const FineMatch& match, int count, float* to);

}  // namespace mfar::simd
