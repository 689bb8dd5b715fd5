#pragma once

#include "base/rows.h"
#include "pipeline/engine/params/flow.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// One pyramid level as the flow kernels read it. Each row's first pixel is repeated 8 times to the
/// left, its last pixel at least 8 times to the right.
struct PatchPicture {
    const std::uint8_t* pixels = nullptr;
    std::ptrdiff_t pitch = 0;
    int width = 0, height = 0;
};

/// Flow field of one pyramid level, one plane per channel: x, y [px of the level], cost, texture.
/// All planes have the same pitch, and kFieldMargin writable elements on each side of their rows.
struct FlowPlanes {
    /// Addresses of cell (0, 0) in each plane.
    float *x = nullptr, *y = nullptr, *cost = nullptr, *texture = nullptr;
    std::ptrdiff_t pitch = 0;
    int columns = 0, rows = 0;
};
inline constexpr int kFieldMargin = 16;

/// A flow field of another frame or step, whose vectors are candidates at every pyramid level.
struct PriorField {
    const float *x = nullptr, *y = nullptr;
    std::ptrdiff_t step = 1, pitch = 0;  ///< distances between cells and between rows [elements]
    float scale = 1;                     ///< pixels of the searched level per field pixel
    /// Columns and rows of this field per column and row of cells of the searched pyramid level.
    float columnsPerCell = 1, rowsPerCell = 1;
};

/// Parameters of the search at one pyramid level in one direction, see flow_search.comp.
struct SearchStep {
    PatchPicture from, to;  ///< patches of `from` are searched in `to`
    FlowPlanes out;
    FlowPlanes
        coarser;  ///< next coarser level, whose vectors are candidates; 0 rows: there is none
    PriorField prior;
    int radius = 0;  ///< radius of whole-pixel candidates at the coarsest level, <= 40
    int candidates = 0;
    int steps = 0;
};
void searchCells(const SearchStep& step, int row, int first, int end);

/// Parameters of the LISTED variant of flow_search.comp. At the finest pyramid level, a cell's
/// vector in `out` is replaced only if the new cost is clearly smaller. Its two-way error in
/// `errors`, the first of four floats per cell, is then replaced too. At coarser levels, `errors`
/// is null, and every cell takes the new vector.
struct ListedStep {
    SearchStep search;
    float* errors = nullptr;
    std::ptrdiff_t errorPitch = 0;
};
/// Searches a group of 4x4 cells, or the part of it that lies in the field.
void searchListedGroup(const ListedStep& step, int groupX, int groupY);

/// Parameters of flow_propagate.comp. The candidates of a cell are its neighbours' vectors in `in`.
struct PropagateStep {
    PatchPicture from, to;
    FlowPlanes out, in;
    int steps = 0;
};
void propagateCells(const PropagateStep& step, int row, int first, int end);

/// Parameters of flow_align.comp: Gauss-Newton steps from the flow vectors `seed`. Within a patch,
/// the vector changes as the flow does around the cell.
struct AlignStep {
    PatchPicture from, to;
    FlowPlanes out;
    const float* seed = nullptr;  ///< per cell: flow x, y, two unused; no gaps between rows
    int steps = 0;
};
void alignCells(const AlignStep& step, int row, int first, int end);
/// Copies the vectors of `seed`, with cost and texture 0. Invalid vectors become zero.
void keepSeedCells(const AlignStep& step, int row, int first, int end);

/// Parameters of flow_filter.comp. The margins of the fields must be filled. `known`: reliability
/// of each cell, [0, 1]. `out`: four floats per cell, row by row without gaps.
struct CleanUpStep {
    FlowPlanes in;
    const float* known = nullptr;  ///< same pitch and margins as `in`
    float* out = nullptr;
    int planeFits = 0;
};
using params::kCleanUpRadius;
void cleanUpCells(const CleanUpStep& step, int row, int first, int end);
void copyCells(const CleanUpStep& step, int row, int first, int end);
/// Computes the reliability of the cells of a row. Repeats the outermost cells of x, y and `known`
/// over kCleanUpRadius columns on both sides.
void prepareCleanUpRow(const FlowPlanes& field, float* known, int row);

}  // namespace mfar::simd
