#pragma once

#include "pipeline/flow/luma_image.h"
#include "pipeline/simd/census_rows.h"

#include <cstdint>
#include <vector>

namespace mfar {

using simd::kCensusBits, simd::kNoCensus;

/// 5x5 census transform: bit set where a neighbour is darker than the centre. Invariant to any
/// rising tone curve. Rows [first, last) of `out`; pixels beyond the border repeat it. `seen`, a
/// byte a pixel: kNoCensus where 0; nullptr: all are seen.
/// Source: Zabih and Woodfill, ECCV 1994.
void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out,
            const std::uint8_t* seen = nullptr);

}  // namespace mfar
