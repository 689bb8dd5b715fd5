#pragma once

#include "pipeline/simd/cell_weights.h"
#include "pipeline/simd/detail_kernels.h"
#include "pipeline/simd/still_look_up.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// These functions process rows of cells (4x4 video pixels) in vectors of up to 16 cells. They may
// read and write up to 16 cells beyond the last one.

/// Channels of a cell's sums over its 16 pixels. v: luma of the video. s: luma of the still at the
/// cell's flow. x and y: derivatives of s with respect to the flow. For example, VX is the sum of
/// v x minus 16 (mean of v) (mean of x).
enum SubpixelSum : std::uint8_t { VS, SS, VX, VY, SX, SY, XX, XY, YY, VV };
inline constexpr std::size_t kSubpixelSums = VV + 1;

/// A row of cells that subpixelSumsRow() compares with the still.
struct SubpixelCells {
    int row;
    const float *flowX, *flowY;  ///< [video px]
    /// Change of the flow per pixel along x and along y.
    std::array<const float*, 2> alongX, alongY;
    /// 1 for cells that are compared, otherwise 0.
    const float* compared;
    /// Four rows of the video's luma [1/8 grey level].
    std::array<const std::int16_t*, 4> video;
    float light;  ///< Guidance::light
};

/// Computes the sums of the cells [begin, end). Writes no sums for a vector in which no cell is
/// compared.
void subpixelSumsRow(const LookUpParams& lookUp, const StillPairs& still,
                     const SubpixelCells& cells, int begin, int end,
                     const std::array<float*, kSubpixelSums>& to);

/// Input of subpixelStepRow(): rows with the cells' row in the middle.
struct SubpixelAround {
    std::array<RowsAround, kSubpixelSums> sums;
    RowsAround flowX, flowY;
    std::array<const float*, 2> alongX, alongY;  ///< of the cells' row only
    float noise;                                 ///< standard deviation [grey levels]
};

/// Writes the corrected flow of the cells [begin, end); see params::kSubpixelReach.
void subpixelStepRow(const SubpixelAround& in, int begin, int end, float* flowX, float* flowY);

}  // namespace mfar::simd
