#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kCensusRadius = 2;  ///< of the window [px]
inline constexpr int kCensusBits = 24;
/// Set if a census pixel is invalid because no still was seen there.
inline constexpr std::uint32_t kNoCensus = 1U << 31;

/// 5x5 census of a row: a bit is set if that neighbour is darker than the centre, row by row from
/// the top left, the first neighbour in the highest bit. `rows`: five rows around this one, each
/// with kCensusRadius pixels before the first and after the last. `seen`: 0 where the result is to
/// be kNoCensus; null: all are seen. Source: Zabih and Woodfill, ECCV 1994.
void censusRow(const std::uint8_t* const (&rows)[2 * kCensusRadius + 1], std::size_t width,
               const std::uint8_t* seen, std::uint32_t* out);

}  // namespace mfar::simd
