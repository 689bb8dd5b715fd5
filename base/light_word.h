#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace mfar {

// A light word stores three linear, non-negative values with one common exponent in 32 bits,
// similar to OpenGL's RGB9_E5. Bits 0 to 23 hold three mantissas of 8 bits, bits 24 to 28 the
// exponent, and bits 29 to 31 are free.

inline constexpr int kLightBits = 8, kLightBias = 15, kLightFreeBit = 29;
inline constexpr std::uint32_t kLightExponent = 0x1F;
inline constexpr float kMostLight = 65280;  ///< larger values are clamped to this; NaN becomes 0

[[nodiscard]] inline std::uint32_t packedLight(const std::array<float, 3>& rgb) {
    std::array<float, 3> held{};
    for (std::size_t c = 0; c < 3; ++c)
        held[c] = rgb[c] > 0 ? std::min(rgb[c], kMostLight) : 0;
    const float most = std::max({held[0], held[1], held[2]});
    const int above = most > 0 ? std::ilogb(most) + 1 : -kLightBias;
    int exponent = std::max(above, -kLightBias) + kLightBias;
    const auto steps = [&](float value) {
        return static_cast<std::uint32_t>(
            std::lround(std::ldexp(value, kLightBits + kLightBias - exponent)));
    };
    if (steps(most) >> kLightBits != 0) ++exponent;
    return steps(held[0]) | steps(held[1]) << kLightBits | steps(held[2]) << 2 * kLightBits |
           static_cast<std::uint32_t>(exponent) << 3 * kLightBits;
}

[[nodiscard]] inline std::array<float, 3> unpackedLight(std::uint32_t word) {
    // The scale is 2^(exponent - bias - bits), written into the exponent of a float, whose bias
    // is 127.
    const std::uint32_t exponent =
        (word >> 3 * kLightBits & kLightExponent) + 127 - kLightBias - kLightBits;
    const float scale = std::bit_cast<float>(exponent << 23);
    const auto value = [&](int channel) {
        return scale * static_cast<float>(word >> channel * kLightBits & 0xFFU);
    };
    return {value(0), value(1), value(2)};
}

inline constexpr float kDielectricReflectance = 0.04F;

/// The light of a surface, times the exposure: one light word each for diffuse and specular light.
/// It is not yet multiplied by the surface's colour. The 6 free bits store UnpackedLight::veil.
struct LightWords {
    std::uint32_t diffuse = 0, specular = 0;
    bool operator==(const LightWords&) const = default;
};
struct UnpackedLight {
    std::array<float, 3> diffuse{}, specular{};
    /// Share of the specular light that does not depend on the surface's colour, [0, 1]. It grows
    /// towards grazing angles.
    float veil = 0;
};
inline constexpr float kMostVeil = 63;

[[nodiscard]] inline LightWords packedWords(const UnpackedLight& light) {
    const auto veil = static_cast<std::uint32_t>(
        std::lround(kMostVeil * (light.veil > 0 ? std::min(light.veil, 1.0F) : 0)));
    return {packedLight(light.diffuse) | veil >> 3 << kLightFreeBit,
            packedLight(light.specular) | (veil & 7U) << kLightFreeBit};
}
[[nodiscard]] inline UnpackedLight unpackedWords(const LightWords& words) {
    const std::uint32_t veil =
        words.diffuse >> kLightFreeBit << 3 | words.specular >> kLightFreeBit;
    return {unpackedLight(words.diffuse), unpackedLight(words.specular),
            static_cast<float>(veil) / kMostVeil};
}

inline void addShare(UnpackedLight& sum, float share, const UnpackedLight& other) {
    for (std::size_t c = 0; c < 3; ++c) {
        sum.diffuse[c] += share * other.diffuse[c];
        sum.specular[c] += share * other.specular[c];
    }
    sum.veil += share * other.veil;
}

}  // namespace mfar
