#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/simd/cell_weights.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

// These functions process rows of cells (4x4 video pixels) in vectors of up to 16 cells.

/// Variances and covariance of the finest detail of video and still, for each cell [grey levels^2].
/// The finest detail is the difference of a pixel from the mean of its 2x2 block.
struct FineSums {
    float *video, *both, *still;
};

/// Computes FineSums from the two middle pixel rows of a row of cells. `video`: two rows [1/8 grey
/// level]. `still`: four rows with 2x2 samples per video pixel [1/32 grey level]; they are
/// overwritten.
void fineSumsRow(const std::array<const std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end, const FineSums& to);

/// FineSums of the sampled rows above and below a row of cells. If the row itself is sampled,
/// `above` and `below` are the row itself. Each row has one more cell on both sides, which repeats
/// the outermost cell.
struct FineSumsNear {
    struct Pair {
        const float *above, *below;
    };
    Pair video, both, still;
};

/// Computes for each cell the factor of its weight, [0, 1]; see params::kFineRoom. FineSums are
/// averaged over three columns and two rows of cells.
void fineShareRow(const FineSumsNear& sums, const FineMatch& match, int count, float* to);

}  // namespace mfar::simd
