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

/// The flow field of an earlier frame or step. Its vectors are candidates at every pyramid level.
struct PriorField {
    const float *x = nullptr, *y = nullptr;
    std::ptrdiff_t step = 1, pitch = 0;  ///< distances between cells and between rows [elements]
    float scale = 1;  ///< factor from this field's flow to pixels of the searched pyramid level
    /// Size of this field [cells] divided by the size of the searched level's field [cells].
    float columnsPerCell = 1, rowsPerCell = 1;
};

/// Parameters of the search at one pyramid level in one direction, see flow_search.comp.
struct SearchStep {
    PatchPicture from, to;  ///< patches of `from` are searched in `to`
    FlowPlanes out;
    /// Field of the next coarser pyramid level, whose vectors are candidates. It has 0 rows at the
    /// coarsest level.
    FlowPlanes coarser;
    PriorField prior;
    int radius = 0;  ///< radius of whole-pixel candidates at the coarsest level, <= 40
    int candidates = 0;
    int steps = 0;
};
void searchCells(const SearchStep& step, int row, int first, int end);

/// Parameters of the LISTED variant of flow_search.comp. Each cell has an old vector in
/// `search.out`, and the search finds a new one. At coarser pyramid levels, `errors` is null, and
/// the new vector always replaces the old one. At the finest pyramid level, there are two cases.
/// If the ends of the two vectors are at most kOnLine apart, the new vector replaces the old one,
/// and the cell's two-way error (the first of the cell's four floats in `errors`) stays. Otherwise,
/// the new vector replaces the old one only if it costs clearly less (kClearlyLess). In this case,
/// an error that is computed from the new cost replaces the two-way error; see kErrorPerCost.
struct ListedStep {
    SearchStep search;
    float* errors = nullptr;
    std::ptrdiff_t errorPitch = 0;  ///< from one row of cells to the next [floats]
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

/// Parameters of flow_align.comp, which refines the flow vectors in `seed` by Gauss-Newton steps.
/// Patches are deformed according to the change of the flow around the cell.
struct AlignStep {
    PatchPicture from, to;
    FlowPlanes out;
    /// Four floats per cell, row by row without gaps: flow x and y [px], and two unused values.
    const float* seed = nullptr;
    int steps = 0;
};
void alignCells(const AlignStep& step, int row, int first, int end);
/// Copies the vectors of `seed` to `out`, with cost and texture 0. Components that are NaN or too
/// large become 0.
void keepSeedCells(const AlignStep& step, int row, int first, int end);

/// Parameters of flow_filter.comp. The margins of in.x, in.y and `known` must repeat the outermost
/// cells. prepareCleanUpRow() fills the margins to the left and right. The caller must fill
/// kCleanUpRadius rows above and below the field. `known`: reliability of each cell, [0, 1]. `out`:
/// four floats per cell, row by row without gaps.
struct CleanUpStep {
    FlowPlanes in;
    const float* known = nullptr;  ///< same pitch and margins as `in`
    float* out = nullptr;
    int planeFits = 0;
};
using params::kCleanUpRadius;
void cleanUpCells(const CleanUpStep& step, int row, int first, int end);
void copyCells(const CleanUpStep& step, int row, int first, int end);
/// Writes the reliability of a row's cells to `known`. Fills kCleanUpRadius columns of the margins
/// of field.x, field.y and `known` with the outermost cells.
void prepareCleanUpRow(const FlowPlanes& field, float* known, int row);

}  // namespace mfar::simd
