#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/simd/cell_weights.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

// These functions process rows of cells (4x4 video pixels) in vectors of up to 16 cells.

/// Variances and covariance of the finest detail of video and still, for each cell [grey levels^2];
/// see params::kFineRoom.
struct FineSums {
    float *video, *both, *still;
};

/// Computes FineSums of the cells [begin, end) from the two middle pixel rows of a row of cells.
/// All rows begin at the first cell of the frame. `video`: two rows of luma [1/8 grey level].
/// `still`: four rows, which contain 2x2 samples of luma for each video pixel [1/32 grey level];
/// they are overwritten. `pixels`: width of the frame [video px]. The first pixel to the right of
/// the cells is also read; at the end of the frame, it is replaced by the frame's last pixel.
void fineSumsRow(const std::array<std::int16_t*, 2>& video,
                 const std::array<std::int16_t*, 4>& still, int begin, int end, int pixels,
                 const FineSums& to);

/// FineSums of a row of cells and of the rows around it.
struct FineSumsAround {
    RowsAround video, both, still;
};

/// Computes for each cell the factor of its weight, [0, 1]; see params::kFineRoom. FineSums are
/// averaged over 3x3 cells. `kinks` and `variance`: rows of SurfaceCells.
void fineShareRow(const FineSumsAround& sums, const float* kinks, const float* variance,
                  const FineMatch& match, int count, float* to);

}  // namespace mfar::simd
