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

/// Describes where the still shows points of a frame. The points are first moved by s * motion.move
/// (see EpipolarLens), then rotated. The result is (nowhere, nowhere) for a point behind the still
/// camera, and for a point whose x or y is beyond +-nowhere.
struct FlowEnds {
    Lens lens;
    Motion motion;
    float nearPlane;  ///< smallest z that a moved ray (x, y, 1) may have after the rotation
    float nowhere;    ///< coordinate of points that the still does not show [px]
};

/// A row of cells: rays through the cells' centres, and these centres [px].
struct CellRow {
    const float *raysX, *raysY;
    const float* middlesX;
    float middleY;
    std::size_t count;
};

/// Inverse depth of cells: the median of a cell's four central pixels (mean of the middle two).
/// `upper`, `lower`: second and third pixel row of the cells, starting at the first pixel of the
/// first cell.
void cellDepths(const float* upper, const float* lower, std::size_t count, float* out);

/// Flow of cells with inverse depth `s`.
void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow);

/// Finds the cells of another picture to which the flow of row `j` points. `cells`: number of cells
/// of that picture. `landing`: row-major index of each of these cells; -1: outside the picture.
void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing);

/// Writes to the first entry of `out` how far each cell lies behind the nearest surface that lands
/// on the same cell of the other picture [px of parallax]: nearest[landing] - s, converted to
/// pixels, minus `slope`, but at least 0; `nowhere` if `landing` is -1. `nearest`: largest inverse
/// depth that lands on each cell of the other picture.
struct HiddenRule {
    float pixelsPerUnit, slope, nowhere;
};
void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out);

/// Changes the inverse depth `s` of each cell so that its flow, now `start`, moves along its
/// epipolar line to the point nearest to `flow`. `step`: change of s that moves a point by about a
/// pixel. Cells whose flow changes by less than `leastWay` [px] per `step` remain unchanged.
void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s);

/// Motion of cells from one frame to the next, given their rays and inverse depths.
struct CellMotion {
    Lens lens;           ///< lens of the frames' camera, with pixels as large as cells
    Motion motion;       ///< transforms points from the last frame's camera to the next frame's
    float lastZ, nextZ;  ///< z of both frames' camera centres, relative to the still's [units]
    float perUnit;       ///< converts inverse depth to the units of the next frame
    float nearPlane;
};
/// Predicts the next frame's cells from those of the last one. `cells`: number of cells of the next
/// frame. `landing`: for each cell, index of the next frame's cell that shows the same point, -1 if
/// none does. `moved`: the point's inverse depth in the next frame.
void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved);

}  // namespace mfar::simd
