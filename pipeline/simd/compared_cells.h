#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_plane.h"

#include <cstdint>

namespace mfar::simd {

/// The flow of all cells, and which of them are compared with the still at its full resolution.
/// Allocates memory only in the constructor.
class ComparedCells {
public:
    explicit ComparedCells(Size video);

    /// Sets a row. Cells in matched tiles are compared if all their pixels are in the video. `flow`
    /// and `errors` have one entry per cell of the frame. `errors`: may be null; otherwise, cells
    /// with an error of kNotShown or more are not compared.
    void take(int row, const TileWork& work, const FlowCell* flow, const ErrorCell* errors);
    /// Sets the flow of a row, and leaves which cells are compared.
    void takeFlow(int row, const FlowCell* flow);

    /// Allocates memory for the luma of a row of cells.
    [[nodiscard]] AlignedRows<std::int16_t> makeLuma() const;
    /// Writes four rows of luma [1/8 grey level] of the cells [first, last) of a row.
    void takeLuma(const RgbPlanes& from, int row, int first, int last,
                  AlignedRows<std::int16_t>& to) const;

    const Size video, cells;
    CellPlane flowX, flowY;
    CellPlane compared;  ///< 1 for cells that are compared, otherwise 0
};

}  // namespace mfar::simd
