#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kCensusRadius = 2;
inline constexpr int kCensusBits = 24;
inline constexpr std::uint32_t kNoCensus = 1U << 31;

/// Computes the 5x5 census of a row: a bit is set if its neighbour is darker than the centre.
/// Neighbours are numbered row by row from the top left; the first one has the highest bit. `rows`:
/// five rows with this row in the middle, each with kCensusRadius more pixels on both sides.
/// `seen`: where it is 0, the result is kNoCensus; null: all pixels are valid. Source: Zabih and
/// Woodfill, ECCV 1994.
void censusRow(const std::uint8_t* const (&rows)[2 * kCensusRadius + 1], std::size_t width,
               const std::uint8_t* seen, std::uint32_t* out);

}  // namespace mfar::simd
