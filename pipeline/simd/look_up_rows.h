#pragma once

#include "base/geometry.h"
#include "pipeline/engine/cells.h"
#include "pipeline/simd/cell_rows.h"
#include "pipeline/simd/detail_kernels.h"

#include <array>
#include <vector>

namespace mfar::simd {

/// Tables that enlarge a field of LookUpCells to the output's size. All threads share them.
struct LookUpTaps {
    /// `stillRig`: its still camera has the resolution of the still that is read. `output`: size of
    /// the whole enlarged video.
    LookUpTaps(const StereoRig& stillRig, Size output);

    RowTaps rows, columns;
    Size cells;
    float stepX, stepY;  ///< still pixels per output pixel
    /// First output column to the right of the centre of each column of cells, and the first one
    /// that is nearer to this centre than to the one before. One more entry at the end is the
    /// output's width.
    std::vector<int> rightOf, nearTo;
};

/// Enlarges a field of LookUpCells to rows of the output: interpolates them, but not across jumps
/// of the flow; see params::kJump. Each thread has its own object.
class LookUpRowCache {
public:
    LookUpRowCache(Size cells, int outputWidth)
        : cells_(cells.width, outputWidth), nearest_({outputWidth, kKept * kChannels}) {}

    /// Starts with a new field. Only pixels [begin, end) of the output are computed. `confident`:
    /// LookUpRows::share is the confidence if true, the weight if false.
    void begin(Rows<const LookUpCell> field, const LookUpTaps& taps, bool confident, int begin,
               int end);
    /// Returns row y of the output, which is computed from two rows of cells. The result stays
    /// valid while later calls need only rows of cells that are at most three rows away from both.
    [[nodiscard]] LookUpRows row(int y);

private:
    static constexpr int kChannels = 3;
    static constexpr int kKept = 8;  // four pairs of rows, each with two nearer rows
    using Channels = std::array<float, kChannels>;
    using Wide = std::array<const float*, kChannels>;

    [[nodiscard]] Channels channelsOf(const LookUpCell& cell) const;
    [[nodiscard]] Wide enlarged(int row);
    [[nodiscard]] bool jumpsBelow(int row) const;
    [[nodiscard]] Wide withNearest(int upperRow, const Wide& far, const Wide& near, int slot);

    Rows<const LookUpCell> field_;
    const LookUpTaps* taps_ = nullptr;
    bool confident_ = false;
    int begin_ = 0, end_ = 0;
    int firstCell_ = 0, lastCell_ = 0;
    CellRows<LookUpCell, kChannels> cells_;
    AlignedRows<float> nearest_;
    std::array<int, kKept> nearestRows_{};
};

}  // namespace mfar::simd
