#pragma once

#include <cstdint>

namespace mfar::simd {

/// Paint of a texel or pixel: the diffuse colour, and the reflectance along the normal, each as
/// bytes of red, green and blue. These colours can be averaged. Means of base colour and metallic
/// would be wrong where metal meets another material.
struct PaintWords {
    std::uint32_t diffuse = 0, facing = 0;
    bool operator==(const PaintWords&) const = default;
};

}  // namespace mfar::simd
