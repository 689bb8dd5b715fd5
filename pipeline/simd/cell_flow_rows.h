#pragma once

#include "base/image_view.h"
#include "pipeline/simd/depth_rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Flow x, y [px] of a cell of 4x4 pixels, followed by two unused entries.
using CellVector = std::array<float, 4>;

/// Maps points of a frame to the still. A point is first moved by s * motion.move (see
/// EpipolarLens), then rotated. The result is (nowhere, nowhere) for a point behind the still
/// camera, and for a point whose x or y is beyond +-nowhere.
struct FlowEnds {
    Lens lens;
    Motion motion;
    /// nearPlane: smallest valid z of a ray (x, y, 1) after the rotation. nowhere: coordinate of
    /// points outside the still [px].
    float nearPlane;
    float nowhere;
};

/// A row of cells: the rays through their centres, and the pixel coordinates of the centres.
struct CellRow {
    const float *raysX, *raysY;
    const float* middlesX;
    float middleY;
    std::size_t count;
};

/// Writes the inverse depth of each cell: the median of its four central pixels (mean of the middle
/// two values). `upper`, `lower`: second and third pixel row of the cells, from the first cell's
/// first pixel on.
void cellDepths(const float* upper, const float* lower, std::size_t count, float* out);

void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow);

/// Finds the cell of another picture to which each cell's flow points. `j`: row of the cells.
/// `cells`: size of the other picture in cells. `landing`: row-major index of the cell that was
/// found, or -1 outside the picture.
void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing);

/// cellsHidden() computes how far each cell lies behind the nearest surface that lands on the same
/// cell of the other picture [px of parallax]. The distance is (nearest[landing] - s) *
/// pixelsPerUnit - slope, limited to [0, nowhere]. It is `nowhere` if `landing` is -1. `nearest`:
/// largest inverse depth that lands on each cell of the other picture. `slope`: parallax [px] that
/// two cells of one slanted surface can have. The result is written to the first entry of `out`.
struct HiddenRule {
    float pixelsPerUnit, slope, nowhere;
};
void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out);

/// Adjusts the inverse depth `s` of each cell to its measured `flow`. The new `s` moves the cell's
/// point along its epipolar line to the position nearest to `flow`. `start`: flow of the old `s`.
/// `step`: change of s that moves a point by about a pixel. Cells whose point moves by less than
/// `leastWay` [px] per `step` remain unchanged.
void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s);

struct CellMotion {
    /// Lens of the frames' camera, scaled to pixels as large as cells, and motion from the last
    /// frame's camera to the next frame's. lastZ, nextZ: z of both camera centres, relative to the
    /// still camera [units]. perUnit: converts inverse depth to the units of the next frame.
    Lens lens;
    Motion motion;
    float lastZ, nextZ;
    float perUnit;
    float nearPlane;
};
/// Finds the cells of the next frame that show the points of the last frame's cells. `cells`: size
/// of the next frame in cells. `landing`: index of the next frame's cell, or -1 if none shows the
/// point. `moved`: the point's inverse depth in the next frame.
void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved);

}  // namespace mfar::simd
