#pragma once

#include "base/rows.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/simd/cell_weights.h"

#include <algorithm>

namespace mfar::simd {

/// Rounds the width up to a multiple of the kernels' longest vector (16 cells).
[[nodiscard]] inline Size wholeVectors(Size cells) {
    constexpr int kLongest = 16;
    return {(cells.width + kLongest - 1) / kLongest * kLongest, cells.height};
}

/// One value per cell. Each row has margins. repeatBorder() copies the row's first and last value
/// to the nearest entry of each margin.
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
    [[nodiscard]] RowsAround around(int y) {
        return {(*this)[std::max(y - 1, 0)], (*this)[y],
                (*this)[std::min(y + 1, cells_.height - 1)]};
    }

private:
    static constexpr int kMargin = 16;
    Size cells_;
    AlignedRows<float> rows_;
};

/// Joins adjacent tiles of a tile row that are all matched or all unmatched (TileWork). Calls
/// body(matched, first, last) for each such group, which contains the columns [first, last) of
/// cells.
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
