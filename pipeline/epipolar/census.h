#pragma once

#include "pipeline/flow/luma_image.h"
#include "pipeline/simd/census_rows.h"

#include <cstdint>
#include <vector>

namespace mfar {

using simd::kCensusBits, simd::kNoCensus;

/// Computes the census transform of a picture over 5x5 pixels. A pixel's census has a bit for each
/// neighbour, which is set if the neighbour is darker than the pixel. A rising tone curve does not
/// change it. Fills rows [first, last) of `out`. Pixels beyond the picture repeat its border.
/// `seen`: one byte per pixel; where it is 0, the pixel is invalid, and `out` becomes kNoCensus.
/// Null: all pixels are valid. Source: Zabih and Woodfill, ECCV 1994.
void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out,
            const std::uint8_t* seen = nullptr);

}  // namespace mfar
