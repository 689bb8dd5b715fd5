#pragma once

#include "base/light_word.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

// Mirrored light changes with every motion of the camera. A picture stores what its surfaces mirror
// with and the distant light that they mirror, so that this light can be computed anew for the view
// that is shown.

/// How a pixel's surface mirrors: its normal in the world on the octahedral map (Cigolle et al.
/// 2014), 16 bits an axis, and bytes of roughness, reflectance along the normal, and
/// SpecularAlbedo::full(). All zero: unknown.
struct GlossWords {
    std::uint32_t normal = 0, look = 0;
    bool operator==(const GlossWords&) const = default;
};
inline constexpr std::uint32_t kIsGloss = 1U << 24;  ///< set in `look` if it is known

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

/// Distant light, averaged over the lobes that surfaces of some roughnesses mirror, as tables on
/// the octahedral map with light words.
struct MirrorLight {
    struct Table {
        float roughness = 0;
        int edge = 0;             ///< texels a side, the repeated border included
        std::uint32_t first = 0;  ///< texel
    };
    std::vector<Table> tables;  ///< ascending roughness, the first 0
    std::vector<std::uint32_t> texels;
    std::array<float, 3> towardsSun{0, 0, 1}, sunIrradiance{};  ///< no sun: 0
    float leastSunAlpha = 0;  ///< a lobe is at least as wide as the sun's disc
    float least = 0;          ///< lower limit of the light
};

}  // namespace mfar
