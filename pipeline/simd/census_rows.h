#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kCensusRadius = 2;
inline constexpr int kCensusBits = 24;
inline constexpr std::uint32_t kNoCensus = 1U << 31;

/// Computes the 5x5 census of each pixel of a row: one bit per neighbour, 1 if the neighbour is
/// darker than the pixel. Neighbours are numbered row by row from the top left; the first one has
/// the highest of the kCensusBits bits. `rows`: five rows with this row in the middle. Each begins
/// kCensusRadius pixels before the first of the `width` pixels and ends kCensusRadius pixels after
/// the last one. `seen`: a flag per pixel; if it is 0, the pixel's result is kNoCensus. If `seen`
/// is null, all pixels are valid. Source: Zabih and Woodfill, ECCV 1994.
void censusRow(const std::uint8_t* const (&rows)[2 * kCensusRadius + 1], std::size_t width,
               const std::uint8_t* seen, std::uint32_t* out);

}  // namespace mfar::simd
