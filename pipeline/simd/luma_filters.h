#pragma once

#include "base/rows.h"

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Rounded means of 2x2 pixels of two rows: `width` results.
void halveRow(const std::uint8_t* first, const std::uint8_t* second, std::size_t width,
              std::uint8_t* out);
/// Every second byte, starting with the first: `width` results; reads nothing after the last.
void thinRow(const std::uint8_t* in, std::size_t width, std::uint8_t* out);

/// Three taps in each direction; `side`: weight of a neighbour in 1/256, at most 85; the border
/// repeats.
void smoothRow(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
               std::size_t width, int side, std::uint8_t* out);

/// For `width` columns from (1, first), sums the absolute response of a mask over `rows` rows, at
/// most 16. Planes, and steps or lines along an axis, give no response: 1 -2 1, -2 4 -2, 1 -2 1.
/// Source: Immerkaer, Fast noise variance estimation, 1996.
void noiseColumns(const Rows<const std::uint8_t>& picture, int first, int rows, std::size_t width,
                  std::uint16_t* out);

/// to[i] += weight * from[i].
void addWeighted(const std::uint8_t* from, float weight, std::size_t count, float* to);

}  // namespace mfar::simd
