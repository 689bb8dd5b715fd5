#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/simd/cell_weights.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

// Rows of cells of 4x4 video pixels, read and written in vectors of up to 16 cells.

/// Variances and covariance of the finest detail of video and still, per cell: mean products of the
/// pixels' differences from the mean of their 2x2 block [grey levels^2].
struct FineSums {
    float *video, *both, *still;
};

/// Computed from the two middle pixel rows of a row of cells. `video` [1/8 grey level]. `still`:
/// 2x2 samples per pixel, so two rows of samples for each row of the video [1/32 grey level];
/// overwritten as scratch.
void fineSumsRow(const std::array<const std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end, const FineSums& to);

/// Sums of the sampled rows above and below a row of cells; if the row itself is sampled, both are
/// that row. Each repeats its border 1 cell to the left and to the right.
struct FineSumsNear {
    struct Pair {
        const float *above, *below;
    };
    Pair video, both, still;
};

/// Share of their weight that cells keep, from sums averaged over three columns: see
/// params::kFineRoom.
void fineShareRow(const FineSumsNear& sums, const FineMatch& match, int count, float* to);

}  // namespace mfar::simd
