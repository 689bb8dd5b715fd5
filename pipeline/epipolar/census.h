#pragma once

#include "pipeline/flow/luma_image.h"

#include <cstdint>
#include <vector>

namespace mfar {

inline constexpr int kCensusBits = 24;
/// Set where a census pixel stands for nothing: no still was seen there.
inline constexpr std::uint32_t kNoCensus = 1U << 31;

/// 5x5 census transform: bit set where a neighbour is darker than the centre. Invariant to any
/// rising tone curve. Rows [first, last) of `out`; pixels beyond the border repeat it.
/// Source: Zabih and Woodfill, ECCV 1994.
void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out);

}  // namespace mfar
