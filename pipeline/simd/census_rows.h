#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kCensusRadius = 2;  ///< of its window [px]
inline constexpr int kCensusBits = 24;
/// Set where a census pixel stands for nothing: no still was seen there.
inline constexpr std::uint32_t kNoCensus = 1U << 31;

/// 5x5 census of a row: bit set where a neighbour is darker than the centre, row by row from the
/// top left, the first neighbour in the highest bit. `rows`: five, the middle one the row's own,
/// each from kCensusRadius pixels before its first to as many behind its last. `seen`: 0 where the
/// result is kNoCensus; nullptr: nowhere. Source: Zabih and Woodfill, ECCV 1994.
void censusRow(const std::uint8_t* const (&rows)[2 * kCensusRadius + 1], std::size_t width,
               const std::uint8_t* seen, std::uint32_t* out);

}  // namespace mfar::simd
