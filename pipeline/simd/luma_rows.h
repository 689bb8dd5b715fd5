#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Rounded Rec. 601 luma of `pixels` texels of four bytes, in the order R G B or, with `bgr`, B G
/// R.
void lumaRow(const std::uint8_t* texels, bool bgr, std::size_t pixels, std::uint8_t* luma);

}  // namespace mfar::simd
