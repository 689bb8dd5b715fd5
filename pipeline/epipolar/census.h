#pragma once

#include "pipeline/flow/luma_image.h"
#include "pipeline/simd/census_rows.h"

#include <cstdint>
#include <vector>

namespace mfar {

using simd::kCensusBits, simd::kNoCensus;

/// 5x5 census transform: a bit is set where a neighbour is darker than the centre. It remains the
/// same under any rising tone curve. Fills rows [first, last) of `out`. Pixels beyond the picture
/// repeat its border. `seen`: one byte per pixel; where it is 0, `out` becomes kNoCensus. If `seen`
/// is null, all pixels are valid. Source: Zabih and Woodfill, ECCV 1994.
void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out,
            const std::uint8_t* seen = nullptr);

}  // namespace mfar
