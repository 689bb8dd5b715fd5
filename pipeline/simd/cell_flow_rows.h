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

/// Parameters for projecting the points of a frame into the turned still, a picture of the still
/// with the lens and the orientation of the video camera. A point with inverse depth s lies on the
/// ray r of its pixel. Its ray in the turned still is turn * (r + s (move - r move.z)), see
/// EpipolarLens.
struct FlowEnds {
    Lens lens;  ///< lens of the video camera
    Motion motion;
    float nearPlane;  ///< a point is valid only if z of its ray in the turned still exceeds this
    /// A point is valid only if |x| and |y| of its projection are less than this [px]. An invalid
    /// point gets the position x = y = nowhere.
    float nowhere;
};

/// A row of cells: rays (x, y, 1) through the cells' centres, and the pixel coordinates of these
/// centres.
struct CellRow {
    const float *raysX, *raysY;
    const float* middlesX;
    float middleY;
    std::size_t count;
};

/// Computes an inverse depth for each cell of 4x4 pixels: the mean of the second and the third
/// largest of the inverse depths of its four central pixels. `upper`, `lower`: second and third
/// pixel row of the cells, from the first cell's first pixel on.
void cellDepths(const float* upper, const float* lower, std::size_t count, float* out);

/// Computes the flow of each cell from its inverse depth `s`.
void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow);

/// Finds the cell of another picture to which each cell's flow points. `flow`: row `j` of cells.
/// `cells`: size of both pictures in cells. `landing`: row-major index of the cell that was found,
/// or -1 if the flow points outside the picture.
void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing);

/// Parameters of cellsHidden(), which tests if a nearer surface hides a cell in the other picture.
/// `landing`: cell of the other picture that shows the cell's point; -1: no cell shows it.
/// `nearest[k]`: largest s of all cells with landing k. In the cell's entry of `out`, the first
/// number is the cell's distance behind the nearest surface [px of parallax]: (nearest[landing] -
/// s) * pixelsPerUnit - slope, limited to [0, nowhere]. It is `nowhere` if `landing` is -1; the
/// other numbers are 0. `slope`: largest parallax [px] between two cells of one slanted surface.
struct HiddenRule {
    float pixelsPerUnit, slope, nowhere;
};
void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out);

/// Adjusts the inverse depth `s` of each cell to its measured `flow`. The new `s` puts the cell's
/// point on its epipolar line, as near as possible to the end of `flow`. `start`: flow of the old
/// `s`. `step`: change of `s` that moves a point by about a pixel. A cell keeps its old `s` if a
/// change by `step` moves its point by at most `leastWay` [px].
void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s);

struct CellMotion {
    Lens lens;      ///< lens of the frames' camera, for a picture with one pixel per cell
    Motion motion;  ///< from the last frame's camera to the next frame's camera
    /// lastZ: z of the last frame's camera centre relative to the still camera's centre, along the
    /// last frame's optical axis. nextZ: the same for the next frame. Both are in the last frame's
    /// unit of length.
    float lastZ, nextZ;
    float perUnit;  ///< factor that converts s from the last frame's unit to the next frame's
    /// A moved point is valid if its z, multiplied by the point's old s, exceeds this limit. Both
    /// its z relative to the next frame's camera and its z relative to the still camera must
    /// satisfy this.
    float nearPlane;
};
/// Finds the cells of the next frame that show the points of the last frame's cells. `s`: inverse
/// depths of the points. `cells`: size of the next frame in cells. `landing`: row-major index of
/// the next frame's cell, or -1 if none shows the point. `moved`: s of the point for the next
/// frame.
void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved);

}  // namespace mfar::simd
