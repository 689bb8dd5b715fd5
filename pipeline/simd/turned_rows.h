#pragma once

#include "base/rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kTurnedCell = 8;  ///< distance between the grid points of TurnedCells [px]

/// A camera that is rotated relative to a second camera with the same centre.
struct TurnedLens {
    Lens lens;                  ///< the camera's lens; its rim2 is ignored
    std::array<float, 9> turn;  ///< rotates rays of the second camera to this one, row-major
    float rim;                  ///< radius of the outermost visible ray
};

/// Writes the pixel at which the camera `lens` sees each ray (x, y, 1). The rays are given in the
/// coordinates of the second camera of TurnedLens. A ray that is not visible or NaN gives a
/// position far outside the picture.
void turnedPoints(const TurnedLens& lens, const float* raysX, const float* raysY, std::size_t count,
                  float* x, float* y);

/// Two adjacent rows of a grid of positions in the source picture: (x, y) and, one grid row below,
/// (nextX, nextY). The grid has one position for every kTurnedCell pixels of the drawn picture.
struct TurnedCells {
    const float *x, *y, *nextX, *nextY;
};

/// Draws a row of a picture that lies between the two grid rows of `cells`. `v`: distance from the
/// upper grid row in grid cells, [0, 1). Each pixel's position is interpolated bilinearly in the
/// grid, and the source is interpolated bilinearly at this position. `seen` becomes 1 where the
/// position is inside the source, else 0. The source needs at least two columns and two rows.
void turnedRow(const Rows<const std::uint8_t>& source, const TurnedCells& cells, float v,
               std::size_t width, std::uint8_t* out, std::uint8_t* seen);

}  // namespace mfar::simd
