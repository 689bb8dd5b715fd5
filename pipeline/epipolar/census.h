#pragma once

#include "pipeline/flow/luma_image.h"
#include "pipeline/simd/census_rows.h"

#include <cstdint>
#include <vector>

namespace mfar {

using simd::kCensusBits, simd::kNoCensus;

/// Computes the census transform of a picture over 5x5 pixels, for rows [first, last) of `out`.
/// Each bit of a pixel's census belongs to one neighbour, and is set if this neighbour is darker
/// than the pixel. A strictly rising tone curve does not change the census. Pixels outside the
/// picture repeat its border. If `seen` is not null, pixels with 0 in `seen` are invalid and get
/// kNoCensus. Source: Zabih and Woodfill, ECCV 1994.
void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out,
            const std::uint8_t* seen = nullptr);

}  // namespace mfar
