#pragma once

#include "base/geometry.h"
#include "pipeline/engine/cells.h"
#include "pipeline/simd/cell_rows.h"
#include "pipeline/simd/detail_kernels.h"

namespace mfar::simd {

/// Tables for enlarging a field of look-ups to the output's size, shared by all threads.
struct LookUpTaps {
    /// `stillRig`: with the still camera at the resolution that is looked up. `output`: size of the
    /// enlarged whole video.
    LookUpTaps(const StereoRig& stillRig, Size output);

    RowTaps rows, columns;
    Size cells;
    float stepX, stepY;  ///< still pixels per output pixel
};

/// Look-up positions of output rows in the still, and the still's share there. Scratch of one
/// thread.
class LookUpRowCache {
public:
    LookUpRowCache(Size cells, int outputWidth) : cells_(cells.width, outputWidth) {}

    /// Starts a field; only pixels [begin, end) of the output are computed. `confident`: the share
    /// is the confidence instead of the weight.
    void begin(Rows<const LookUpCell> field, const LookUpTaps& taps, bool confident, int begin,
               int end);
    /// Valid until a row four cells away is requested.
    [[nodiscard]] LookUpRows row(int y);

private:
    const LookUpTaps* taps_ = nullptr;
    bool confident_ = false;
    CellRows<LookUpCell, 3> cells_;
};

}  // namespace mfar::simd
