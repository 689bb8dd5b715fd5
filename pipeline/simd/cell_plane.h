#pragma once

#include "base/rows.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_weights.h"

#include <algorithm>

namespace mfar::simd {

/// Returns the size with its width rounded up to whole vectors of the kernels.
[[nodiscard]] inline Size wholeVectors(Size cells) {
    constexpr int kLongest = 16;  // cells in the longest vector
    return {(cells.width + kLongest - 1) / kLongest * kLongest, cells.height};
}

/// One value per cell. Margins on both sides of a row repeat its border.
class CellPlane {
public:
    explicit CellPlane(Size cells)
        : cells_(cells), rows_({2 * kMargin + wholeVectors(cells).width, cells.height}) {}

    [[nodiscard]] float* operator[](int y) { return rows_[y] + kMargin; }
    void repeatBorder(int y) {
        float* row = (*this)[y];
        row[-1] = row[0];
        row[cells_.width] = row[cells_.width - 1];
    }
    /// Returns row y and its neighbours; beyond the plane's border, row y is repeated.
    [[nodiscard]] RowsAround around(int y) {
        return {(*this)[std::max(y - 1, 0)], (*this)[y],
                (*this)[std::min(y + 1, cells_.height - 1)]};
    }

private:
    static constexpr int kMargin = 16;  // [cells]; as long as a cache line
    Size cells_;
    AlignedRows<float> rows_;
};

/// Calls body(matched, first, last) for the longest runs of cells whose tiles are all matched, or
/// all unmatched.
template <class Body>
void forRuns(const TileWork& work, int tileRow, int cellsPerTile, int cells, const Body& body) {
    for (int tile = 0; tile < work.tiles.width;) {
        const bool matched = work.at(tile, tileRow).matched != 0;
        const int begin = tile;
        while (tile < work.tiles.width && (work.at(tile, tileRow).matched != 0) == matched)
            ++tile;
        body(matched, cellsPerTile * begin, std::min(cellsPerTile * tile, cells));
    }
}

}  // namespace mfar::simd
