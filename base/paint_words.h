#pragma once

#include <cstdint>

namespace mfar {

/// The paint of a texel or pixel. `diffuse` is the diffuse colour. `facing` is the reflectance
/// along the normal. Each word has one byte each for red, green and blue. Unlike the pair of base
/// colour and metallic, paint may be averaged over texels even where metal meets another material.
struct PaintWords {
    std::uint32_t diffuse = 0, facing = 0;
    bool operator==(const PaintWords&) const = default;
};

}  // namespace mfar
