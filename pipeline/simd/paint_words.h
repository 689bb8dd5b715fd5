#pragma once

#include <cstdint>

namespace mfar::simd {

/// What a texel or a pixel is painted with, each red, green and blue in bytes: the diffuse colour,
/// and the reflectance along the normal. Where metal and others meet, a mean of base colours and
/// one of metallic would not do.
struct PaintWords {
    std::uint32_t diffuse = 0, facing = 0;
    bool operator==(const PaintWords&) const = default;
};

}  // namespace mfar::simd
