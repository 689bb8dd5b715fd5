#pragma once

#include "pipeline/simd/cell_weights.h"
#include "pipeline/simd/detail_kernels.h"
#include "pipeline/simd/still_look_up.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

/// Cells of a row, and the rows above and below.
struct CellsAround {
    RowsAround flowX, flowY;
    RowsAround compared;  ///< 1 for cells that are compared with the still, otherwise 0
};

/// Finds neighbours whose flow differs from that of a cell by more than params::kOtherSurface. The
/// neighbour in column i and row j of the 3x3 cells around a cell has the bit 3 j + i in
/// `neighbours`. There are bits only if both cells are compared. Processes vectors of up to 16
/// cells, so it may read and write up to 16 entries beyond the last one.
void findFlowSteps(const CellsAround& cells, int count, std::int32_t* neighbours);

/// Pairs of a cell and a flow vector. Up to 16 further pairs are read.
struct FlowPairs {
    const float *row, *column;   ///< of the cell
    const float *flowX, *flowY;  ///< [video px]
    /// The four rows of the cell's luma in the video [1/8 grey level], four pixels per pair.
    std::array<const std::int16_t*, 4> video;
    float light;  ///< Guidance::light
};

/// Compares cells with the still at given flow vectors. Writes the sum of the squared differences
/// of luma over the cell's 16 pixels [grey levels^2], or NaN if the centre of the cell is outside
/// the still. May write up to 16 further errors.
void compareFlowPairs(const LookUpParams& lookUp, const StillPairs& still, const FlowPairs& pairs,
                      int count, float* errors);

}  // namespace mfar::simd
