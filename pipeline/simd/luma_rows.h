#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Writes the rounded Rec. 601 luma of `pixels` texels. A texel has four bytes, in the order R G B
/// or, with `bgr`, B G R.
void lumaRow(const std::uint8_t* texels, bool bgr, std::size_t pixels, std::uint8_t* luma);

}  // namespace mfar::simd
