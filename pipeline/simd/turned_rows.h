#pragma once

#include "base/rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kTurnedCell = 8;  ///< distance between the grid points of TurnedCells [px]

/// A camera that is rotated relative to another camera with the same centre.
struct TurnedLens {
    Lens lens;                  ///< the camera's lens; its rim2 is ignored
    std::array<float, 9> turn;  ///< rotation of the other camera's rays, row-major
    float rim;                  ///< radius of the outermost visible ray
};

/// Writes the pixel coordinates of rays (x, y, 1). They are far outside the picture if a ray is not
/// visible or NaN.
void turnedPoints(const TurnedLens& lens, const float* raysX, const float* raysY, std::size_t count,
                  float* x, float* y);

/// Two adjacent rows of a grid of points in the source picture, one point for every kTurnedCell
/// pixels of the drawn picture.
struct TurnedCells {
    const float *x, *y, *nextX, *nextY;
};

/// Draws a row of a picture. The row lies between the two grid rows of `cells`, `v` grid cells
/// below the upper one, [0, 1). Each pixel's point is interpolated bilinearly in the grid, and the
/// source is interpolated bilinearly at this point. `seen` is 1 where the source has a pixel, else
/// 0. The source must have at least two columns and two rows.
void turnedRow(const Rows<const std::uint8_t>& source, const TurnedCells& cells, float v,
               std::size_t width, std::uint8_t* out, std::uint8_t* seen);

}  // namespace mfar::simd
