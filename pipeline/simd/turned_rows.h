#pragma once

#include "base/rows.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kTurnedCell = 8;  ///< side of the cells that maps are given for [px]

/// Where rays show in another camera of the same centre, after a turn.
struct TurnedLens {
    Lens lens;                  ///< of that camera; its rim does not count
    std::array<float, 9> turn;  ///< of rays, row-major
    float rim;                  ///< radius beyond which it shows nothing
};

/// Pixels of rays (x, y, 1), far outside where there are none; rays that are no numbers have none.
void turnedPoints(const TurnedLens& lens, const float* raysX, const float* raysY, std::size_t count,
                  float* x, float* y);

/// A row of a grid of points in the source, one each kTurnedCell pixels, and the next such row.
struct TurnedCells {
    const float *x, *y, *nextX, *nextY;
};

/// A row of a picture, `v` of a cell below the first of the two rows: the source's pixels, bilinear
/// at points that are bilinear in the grid, and 1 where the source has one, otherwise 0. The source
/// has two columns and two rows at least.
void turnedRow(const Rows<const std::uint8_t>& source, const TurnedCells& cells, float v,
               std::size_t width, std::uint8_t* out, std::uint8_t* seen);

}  // namespace mfar::simd
