#pragma once

#include "base/image_view.h"
#include "pipeline/simd/depth_rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A cell of 4x4 pixels: x, y [px]; the other two entries are not used.
using CellVector = std::array<float, 4>;

/// Describes where the still shows points of a frame. The points are first moved by s * motion.move
/// (see EpipolarLens), then rotated. A point behind the camera, or one that would be seen farther
/// outside than `nowhere`, is placed at (nowhere, nowhere).
struct FlowEnds {
    Lens lens;
    Motion motion;
    float nearPlane;  ///< least depth of a rotated ray whose depth was 1
    float nowhere;    ///< [px]
};

/// A row of cells: rays through the cells' centres, and these centres [px].
struct CellRow {
    const float *raysX, *raysY;
    const float* middlesX;
    float middleY;
    std::size_t count;
};

/// Inverse depth of cells: the mean of the two middle values of a cell's four central pixels.
/// `upper`, `lower`: second and third pixel row of the cells, starting at the first pixel of the
/// first cell.
void cellDepths(const float* upper, const float* lower, std::size_t count, float* out);

/// Flow of cells with inverse depth `s`.
void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow);

/// The cells of another picture (of `cells` cells) on which the cells of row `j` land; -1: outside.
void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing);

/// Writes to the first entry of `out` how far each cell is occluded [px]: nearest[landing] - s,
/// converted to pixels, minus `slope`, but at least 0. It is `nowhere` if the cell lands outside.
struct HiddenRule {
    float pixelsPerUnit, slope, nowhere;
};
void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out);

/// Changes the inverse depth `s` of each cell so that its flow, now `start`, moves along its
/// epipolar line to the point nearest to `flow`. `step`: change of s that moves a point by about a
/// pixel. Cells whose flow changes by less than `leastWay` [px] per step remain unchanged.
void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s);

/// Motion of cells from one frame to the next, given their rays and inverse depths.
struct CellMotion {
    Lens lens;           ///< at the resolution of the cells
    Motion motion;       ///< of points, from the last frame to the next one
    float lastZ, nextZ;  ///< z of both frames' centres relative to the still's [units]
    float perUnit;       ///< converts inverse depth to the units of the next frame
    float nearPlane;
};
/// `landing`: index of the cell on which each cell lands, -1 if outside. `moved`: its inverse depth
/// in the next frame.
void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved);

}  // namespace mfar::simd
