#pragma once

#include "base/image_view.h"
#include "pipeline/simd/depth_rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// x, y [px], -, - of a cell of 4x4 pixels.
using CellVector = std::array<float, 4>;

/// Where the still shows points of a frame: `motion` turns what s moves by motion.move, see
/// EpipolarLens. What is behind the camera, or farther outside than `nowhere` [px], is there.
struct FlowEnds {
    Lens lens;
    Motion motion;
    float nearPlane;  ///< least depth of a turned ray
    float nowhere;    ///< [px]
};

/// A row of cells: rays and middles [px] of their middle pixels.
struct CellRow {
    const float *raysX, *raysY;
    const float* middlesX;
    float middleY;
    std::size_t count;
};

/// s of cells from that of the pixels: mean of the middle two of a cell's four middle pixels.
/// `upper`, `lower`: second and third row of the cells' pixels, from the first cell's first on.
void cellDepths(const float* upper, const float* lower, std::size_t count, float* out);

/// Flow of cells whose inverse depth is `s`.
void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow);

/// The cells of another picture of `cells` that a row `j` of cells lands on; -1: none.
void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing);

/// The first component: by how much cells are hidden, nearest[landing] - s in pixels, less `slope`;
/// `nowhere` where they land on nothing.
struct HiddenRule {
    float pixelsPerUnit, slope, nowhere;
};
void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out);

/// s of cells as close as their lines come to where `flow` ends instead of `start`, both from the
/// cells' middles. `step`: of s, about a pixel; lines that it moves by less than `leastWay` [px]
/// say nothing.
void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s);

/// Where surfaces of one frame are in the next: cells from their rays and s.
struct CellMotion {
    Lens lens;           ///< of cells
    Motion motion;       ///< of points, last frame to next
    float lastZ, nextZ;  ///< how far the frames' centres lie before the still's [units]
    float perUnit;       ///< of the next frame's units
    float nearPlane;
};
/// `landing`: cell, -1 where none; `moved`: s there.
void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved);

}  // namespace mfar::simd
