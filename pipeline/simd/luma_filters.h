#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Halves two rows to one: writes `width` rounded means of 2x2 pixels.
void halveRow(const std::uint8_t* first, const std::uint8_t* second, std::size_t width,
              std::uint8_t* out);
/// Copies every second byte, from the first one on, until `width` bytes are written. Reads nothing
/// after the last copied byte.
void thinRow(const std::uint8_t* in, std::size_t width, std::uint8_t* out);

/// Smooths a row with three taps along each axis. `side`: weight of a neighbour, at most 85
/// [1/256]. Beyond the ends of the row, its outermost pixels count again.
void smoothRow(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
               std::size_t width, int side, std::uint8_t* out);

/// Applies the mask (1 -2 1, -2 4 -2, 1 -2 1) and sums the absolute results in each column. The
/// mask's result is 0 on a plane, and on a horizontal or vertical step or line. Processes `rows`
/// rows (at most 16) from row `first` on, and `width` columns from column 1 on. Source: Immerkaer,
/// Fast noise variance estimation, 1996.
void noiseColumns(const Rows<const std::uint8_t>& picture, int first, int rows, std::size_t width,
                  std::uint16_t* out);

/// Adds weight * from[i] to to[i].
void addWeighted(const std::uint8_t* from, float weight, std::size_t count, float* to);

}  // namespace mfar::simd
