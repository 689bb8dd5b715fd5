#pragma once

#include <cstdint>

namespace mfar {

/// Paint of a texel or pixel, each word with bytes of red, green and blue. `diffuse`: the diffuse
/// colour. `facing`: the reflectance along the normal. Paint can be averaged over texels, whereas
/// means of base colour and metallic would be wrong where metal meets another material.
struct PaintWords {
    std::uint32_t diffuse = 0, facing = 0;
    bool operator==(const PaintWords&) const = default;
};

}  // namespace mfar
