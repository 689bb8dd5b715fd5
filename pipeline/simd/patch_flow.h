#pragma once

#include "base/rows.h"
#include "pipeline/engine/params/flow.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// One pyramid level as the flow kernels read it: bytes, with 8 bytes of replicated border to the
/// left of each row and at least 8 to the right.
struct PatchPicture {
    const std::uint8_t* pixels = nullptr;  ///< address of pixel (0, 0)
    std::ptrdiff_t pitch = 0;              ///< bytes from one row to the next
    int width = 0, height = 0;             ///< [px]
};

/// Flow field of one pyramid level, one plane per channel: x, y [px of the level], cost, texture.
/// All planes have the same pitch, and kFieldMargin writable elements on each side of their rows.
struct FlowPlanes {
    float *x = nullptr, *y = nullptr, *cost = nullptr, *texture = nullptr;  ///< of cell (0, 0)
    std::ptrdiff_t pitch = 0;                                               ///< elements per row
    int columns = 0, rows = 0;                                              ///< number of cells
};
inline constexpr int kFieldMargin = 16;

/// A flow field of another frame or step. Its vectors are candidates at every pyramid level.
struct PriorField {
    const float *x = nullptr, *y = nullptr;
    std::ptrdiff_t step = 1, pitch = 0;  ///< elements from cell to cell, from row to row
    float scale = 1;                     ///< pixels of the searched level per field pixel
    /// Columns and rows of this field per column and row of cells of the searched pyramid level.
    float columnsPerCell = 1, rowsPerCell = 1;
};

/// Parameters of searching one pyramid level in one direction, as flow_search.comp does.
struct SearchStep {
    PatchPicture from, to;  ///< patches of `from` are searched in `to`
    FlowPlanes out;
    FlowPlanes
        coarser;       ///< next coarser level, whose vectors are candidates; 0 rows: there is none
    PriorField prior;  ///< if x is null, there is no prior field
    int radius = 0;    ///< radius of whole-pixel candidates at the coarsest level, <= 40
    int candidates = 0;  ///< number of candidates from the coarser level
    int steps = 0;       ///< number of Gauss-Newton steps
};
/// Searches cells [first, end) of a row.
void searchCells(const SearchStep& step, int row, int first, int end);

/// Parameters of the LISTED variant of flow_search.comp. At the finest pyramid level, a cell
/// replaces its vector in `out` only if the new cost is clearly smaller. `errors`: two-way errors;
/// four floats per cell, of which the first is replaced. At coarser levels, `errors` is null, and
/// every cell takes the new vector.
struct ListedStep {
    SearchStep search;
    float* errors = nullptr;
    std::ptrdiff_t errorPitch = 0;  ///< floats from one row to the next
};
/// Searches a group of 4x4 cells, or the part of it that lies in the field.
void searchListedGroup(const ListedStep& step, int groupX, int groupY);

/// Parameters of flow_propagate.comp: the vectors of a cell's neighbours in `in` are its
/// candidates.
struct PropagateStep {
    PatchPicture from, to;
    FlowPlanes out, in;
    int steps = 0;  ///< number of Gauss-Newton steps
};
void propagateCells(const PropagateStep& step, int row, int first, int end);

/// Parameters of flow_align.comp: Gauss-Newton steps from the flow vectors `seed`. Patches bend as
/// the flow changes over them.
struct AlignStep {
    PatchPicture from, to;
    FlowPlanes out;
    const float* seed = nullptr;  ///< per cell: flow x, y, two unused; no gaps between rows
    int steps = 0;                ///< number of Gauss-Newton steps
};
void alignCells(const AlignStep& step, int row, int first, int end);
/// Copies the seed's vectors, with cost and texture 0. Invalid vectors become zero.
void keepSeedCells(const AlignStep& step, int row, int first, int end);

/// Parameters of flow_filter.comp. The margins of the fields must be filled. `known`: reliability
/// of each cell, [0, 1]. `out`: four floats per cell, row by row without gaps.
struct CleanUpStep {
    FlowPlanes in;
    const float* known = nullptr;  ///< has the pitch and margins of `in`
    float* out = nullptr;
    int planeFits = 0;
};
/// Plane fits read cells within this radius.
using params::kCleanUpRadius;
void cleanUpCells(const CleanUpStep& step, int row, int first, int end);
/// Copies the cells unchanged.
void copyCells(const CleanUpStep& step, int row, int first, int end);
/// Computes the reliability of the cells of a row. Repeats the outermost cells of x, y and `known`
/// over kCleanUpRadius columns on both sides.
void prepareCleanUpRow(const FlowPlanes& field, float* known, int row);

}  // namespace mfar::simd
