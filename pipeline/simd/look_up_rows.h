#pragma once

#include "base/geometry.h"
#include "pipeline/engine/cells.h"
#include "pipeline/simd/cell_rows.h"
#include "pipeline/simd/detail_kernels.h"

namespace mfar::simd {

/// Tables that enlarge a field of LookUpCells to the output's size. All threads share them.
struct LookUpTaps {
    /// `stillRig`: its still camera has the resolution of the still that is read. `output`: size of
    /// the whole enlarged video.
    LookUpTaps(const StereoRig& stillRig, Size output);

    RowTaps rows, columns;
    Size cells;
    float stepX, stepY;  ///< still pixels per output pixel
};

/// Enlarges a field of LookUpCells to rows of the output. Each thread has its own object.
class LookUpRowCache {
public:
    LookUpRowCache(Size cells, int outputWidth) : cells_(cells.width, outputWidth) {}

    /// Starts with a new field. Only pixels [begin, end) of the output are computed. `confident`:
    /// LookUpRows::share is the confidence if true, the weight if false.
    void begin(Rows<const LookUpCell> field, const LookUpTaps& taps, bool confident, int begin,
               int end);
    /// Returns row y of the output, which is computed from two rows of cells. The result stays
    /// valid while later calls need only rows of cells that are at most three rows away from both.
    [[nodiscard]] LookUpRows row(int y);

private:
    const LookUpTaps* taps_ = nullptr;
    bool confident_ = false;
    CellRows<LookUpCell, 3> cells_;
};

}  // namespace mfar::simd
