#pragma once

#include "base/light_word.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

// Mirrored light changes whenever the camera moves. So a path-traced picture stores two things: how
// each pixel's surface mirrors light (GlossWords), and the distant light that it mirrors
// (MirrorLight). From both, the mirrored light is computed for the view that is shown.

/// The surface of a pixel as a mirror. `normal` is the surface normal in world coordinates on the
/// octahedral map (Cigolle et al. 2014), with 16 bits per axis. `look` has one byte each for the
/// roughness, the reflectance along the normal, and the share of light that the surface would
/// mirror if that reflectance were 1. If both words are zero, the surface is unknown.
struct GlossWords {
    std::uint32_t normal = 0, look = 0;
    bool operator==(const GlossWords&) const = default;
};
inline constexpr std::uint32_t kIsGloss = 1U << 24;  ///< bit of `look`: the surface is known

[[nodiscard]] inline GlossWords packedGloss(const std::array<float, 3>& normal, float roughness,
                                            float facing, float full) {
    const float sum = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
    if (!(sum > 0)) return {};
    std::array<float, 2> p{normal[0] / sum, normal[1] / sum};
    if (normal[2] < 0)
        p = {(1 - std::abs(p[1])) * (p[0] < 0 ? -1.0F : 1.0F),
             (1 - std::abs(p[0])) * (p[1] < 0 ? -1.0F : 1.0F)};
    const auto steps = [](float value, float most) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * most));
    };
    return {steps(0.5F * p[0] + 0.5F, 65535) | steps(0.5F * p[1] + 0.5F, 65535) << 16,
            steps(roughness, 255) | steps(facing, 255) << 8 | steps(full, 255) << 16 | kIsGloss};
}

/// The distant light that surfaces mirror, with one table for each of several roughnesses. A table
/// is an octahedral map of directions. Each texel is a light word: the mean light over the
/// reflection lobe around the texel's direction.
struct MirrorLight {
    struct Table {
        float roughness = 0;
        int edge = 0;             ///< texels per side, including the repeated border
        std::uint32_t first = 0;  ///< index of the table's first texel in `texels`
    };
    std::vector<Table> tables;  ///< sorted by roughness; the first table has roughness 0
    std::vector<std::uint32_t> texels;
    std::array<float, 3> towardsSun{0, 0, 1}, sunIrradiance{};  ///< irradiance 0: there is no sun
    /// The sun's angular radius [rad]. The lobe that mirrors the sun has at least this width (GGX's
    /// alpha), because even a perfect mirror shows a sun of this size.
    float leastSunAlpha = 0;
    float least = 0;  ///< small value added to all mirrored light, so that the light is never 0
};

}  // namespace mfar
