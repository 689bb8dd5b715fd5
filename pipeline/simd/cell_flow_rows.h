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

/// Where the still shows points of a frame: `motion` rotates the points after moving them by s *
/// motion.move, see EpipolarLens. Points behind the camera, or farther outside than `nowhere` [px],
/// are placed there.
struct FlowEnds {
    Lens lens;
    Motion motion;
    float nearPlane;  ///< lower limit of the depth of a rotated ray
    float nowhere;    ///< [px]
};

/// A row of cells: rays and centres [px] of their middle pixels.
struct CellRow {
    const float *raysX, *raysY;
    const float* middlesX;
    float middleY;
    std::size_t count;
};

/// Inverse depth of cells from the pixels': mean of the two middle values of a cell's four middle
/// pixels. `upper`, `lower`: second and third pixel row of the cells, from the first cell's first
/// pixel.
void cellDepths(const float* upper, const float* lower, std::size_t count, float* out);

/// Flow of cells whose inverse depth is `s`.
void cellFlow(const FlowEnds& ends, const CellRow& row, const float* s, CellVector* flow);

/// The cells of another picture (of `cells` cells) on which row `j` lands; -1: outside.
void cellLandings(const CellVector* flow, int j, Size cells, std::int32_t* landing);

/// Writes to the first component by how much each cell is occluded: nearest[landing] - s in pixels,
/// less `slope`, at least 0; `nowhere` if the cell lands outside.
struct HiddenRule {
    float pixelsPerUnit, slope, nowhere;
};
void cellsHidden(const std::int32_t* landing, const float* nearest, const float* s,
                 const HiddenRule& rule, std::size_t count, CellVector* out);

/// Moves the inverse depth `s` of each cell to the point of its epipolar line that is closest to
/// the end of `flow` instead of `start`, both from the cells' centres. `step`: change of s that is
/// about a pixel; cells whose end moves by less than `leastWay` [px] per step stay unchanged.
void alignCells(const FlowEnds& ends, const CellRow& row, const CellVector* flow,
                const CellVector* start, float step, float leastWay, float* s);

/// Motion of cells from one frame to the next, given their rays and inverse depth.
struct CellMotion {
    Lens lens;           ///< at the resolution of the cells
    Motion motion;       ///< of points, from the last frame to the next
    float lastZ, nextZ;  ///< how far the frames' centres lie in front of the still's [units]
    float perUnit;       ///< converts inverse depth to the next frame's units
    float nearPlane;
};
/// `landing`: cell index, -1 if outside; `moved`: inverse depth in the next frame.
void predictCells(const CellMotion& motion, const float* raysX, const float* raysY, const float* s,
                  std::size_t count, Size cells, std::int32_t* landing, float* moved);

}  // namespace mfar::simd
