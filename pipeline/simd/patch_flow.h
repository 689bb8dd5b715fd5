#pragma once

#include "base/rows.h"
#include "pipeline/engine/params/flow.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// One pyramid level as the flow kernels read it: bytes, 8 of replicated border left of each row
/// and at least 8 right of it.
struct PatchPicture {
    const std::uint8_t* pixels = nullptr;  ///< of pixel (0, 0)
    std::ptrdiff_t pitch = 0;              ///< bytes
    int width = 0, height = 0;             ///< [px]
};

/// Vectors of one level's cells, one plane per channel: flow x, y [px of the level], cost, texture.
/// All planes have one pitch and kFieldMargin writable elements on each side of their rows.
struct FlowPlanes {
    float *x = nullptr, *y = nullptr, *cost = nullptr, *texture = nullptr;  ///< of cell (0, 0)
    std::ptrdiff_t pitch = 0;                                               ///< elements
    int columns = 0, rows = 0;                                              ///< cells
};
inline constexpr int kFieldMargin = 16;

/// A field of another frame or step whose vectors are candidates at every level.
struct PriorField {
    const float *x = nullptr, *y = nullptr;
    std::ptrdiff_t step = 1, pitch = 0;         ///< elements between cells, between rows
    float scale = 1;                            ///< this level's pixels per pixel of the field
    float columnsPerCell = 1, rowsPerCell = 1;  ///< cells of the field per cell of the level
};

/// One level of one direction of flow_search.comp.
struct SearchStep {
    PatchPicture from, to;  ///< patches of `from` are searched in `to`
    FlowPlanes out;
    FlowPlanes coarser;  ///< its vectors are candidates; no rows: the coarsest level
    PriorField prior;    ///< x is null: no prior
    int radius = 0;      ///< of the square of whole-pixel candidates at the coarsest level, <= 40
    int candidates = 0;  ///< number of candidates from the coarser level
    int steps = 0;       ///< number of Gauss-Newton steps
};
/// Searches cells [first, end) of a row.
void searchCells(const SearchStep& step, int row, int first, int end);

/// The LISTED variant of flow_search.comp: a cell replaces its vector in `out` only if the cost is
/// clearly smaller. `errors`: four floats per cell, of which the first is replaced; null: not the
/// finest level, every cell takes the result.
struct ListedStep {
    SearchStep search;
    float* errors = nullptr;
    std::ptrdiff_t errorPitch = 0;  ///< floats
};
/// Searches a group of 4x4 cells, cut at the field's border.
void searchListedGroup(const ListedStep& step, int groupX, int groupY);

/// flow_propagate.comp: each cell tries its neighbours' vectors of `in`.
struct PropagateStep {
    PatchPicture from, to;
    FlowPlanes out, in;
    int steps = 0;  ///< number of Gauss-Newton steps
};
void propagateCells(const PropagateStep& step, int row, int first, int end);

/// flow_align.comp: Gauss-Newton steps from `seed`, with patches that bend with the field.
struct AlignStep {
    PatchPicture from, to;
    FlowPlanes out;
    const float* seed = nullptr;  ///< flow x, y, -, - of each cell, row by row without gaps
    int steps = 0;                ///< number of Gauss-Newton steps
};
void alignCells(const AlignStep& step, int row, int first, int end);
/// Copies the seed's vectors, with cost and texture 0. Invalid vectors become zero.
void keepSeedCells(const AlignStep& step, int row, int first, int end);

/// flow_filter.comp, on fields with their margins filled. `known`: reliability of each cell, [0,
/// 1]. `out`: four floats per cell, row by row without gaps.
struct CleanUpStep {
    FlowPlanes in;
    const float* known = nullptr;  ///< pitch and margins as those of `in`
    float* out = nullptr;
    int planeFits = 0;
};
/// Radius in cells that plane fits read.
using params::kCleanUpRadius;
void cleanUpCells(const CleanUpStep& step, int row, int first, int end);
/// Copies the cells unchanged.
void copyCells(const CleanUpStep& step, int row, int first, int end);
/// Computes the reliability of the cells of a row; repeats the outermost cells of x, y and `known`
/// over kCleanUpRadius columns on both sides.
void prepareCleanUpRow(const FlowPlanes& field, float* known, int row);

}  // namespace mfar::simd
