#pragma once

#include "base/rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kTurnedCell = 8;  ///< side of the cells of a grid of points [px]

/// A rotated camera with the same centre, in which rays are shown.
struct TurnedLens {
    Lens lens;                  ///< of that camera; its rim2 is ignored
    std::array<float, 9> turn;  ///< rotation of rays, row-major
    float rim;                  ///< radius of the outermost visible ray
};

/// Pixels of rays (x, y, 1); far outside if the ray is not visible or NaN.
void turnedPoints(const TurnedLens& lens, const float* raysX, const float* raysY, std::size_t count,
                  float* x, float* y);

/// Two adjacent rows of a grid of points in the source, one point each kTurnedCell pixels.
struct TurnedCells {
    const float *x, *y, *nextX, *nextY;
};

/// A row of a picture, `v` of a cell below the first grid row: source pixels, sampled bilinearly at
/// points that are interpolated bilinearly in the grid; and 1 where the source has a pixel, else 0.
/// The source must have at least two columns and two rows.
void turnedRow(const Rows<const std::uint8_t>& source, const TurnedCells& cells, float v,
               std::size_t width, std::uint8_t* out, std::uint8_t* seen);

}  // namespace mfar::simd
