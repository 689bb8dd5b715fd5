#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Writes `width` rounded means of 2x2 pixels of two rows.
void halveRow(const std::uint8_t* first, const std::uint8_t* second, std::size_t width,
              std::uint8_t* out);
/// Copies every second byte, from the first one on, until `width` bytes are written. Reads nothing
/// after the last copied byte.
void thinRow(const std::uint8_t* in, std::size_t width, std::uint8_t* out);

/// Smooths a row with three taps along each axis. `side`: weight of a neighbour in 1/256, at most
/// 85. Pixels beyond the border repeat it.
void smoothRow(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
               std::size_t width, int side, std::uint8_t* out);

/// Sums the absolute responses of a mask over `rows` rows (at most 16) from row `first` on. Does so
/// for `width` columns from column 1 on. The mask is (1 -2 1, -2 4 -2, 1 -2 1). It does not respond
/// to planes, nor to steps and lines along an axis. Source: Immerkaer, Fast noise variance
/// estimation, 1996.
void noiseColumns(const Rows<const std::uint8_t>& picture, int first, int rows, std::size_t width,
                  std::uint16_t* out);

void addWeighted(const std::uint8_t* from, float weight, std::size_t count, float* to);

}  // namespace mfar::simd
