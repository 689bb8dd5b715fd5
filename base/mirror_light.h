#pragma once

#include "base/light_word.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

// Mirrored light changes with every motion of the camera. A picture stores how its surfaces mirror
// and which distant light they mirror, so that this light can be computed again for the view that
// is shown.

/// A pixel's surface as a mirror of light. `normal` is its normal in the world on the octahedral
/// map (Cigolle et al. 2014), with 16 bits per axis. `look` has a byte each for the roughness, the
/// reflectance along the normal, and SpecularAlbedo::full(). If all is zero, it is unknown.
struct GlossWords {
    std::uint32_t normal = 0, look = 0;
    bool operator==(const GlossWords&) const = default;
};
inline constexpr std::uint32_t kIsGloss = 1U << 24;  ///< bit of `look`, set if the surface is known

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

/// Distant light as surfaces mirror it. There is a table for each of some roughnesses; it has the
/// mean light over the lobe of each direction on the octahedral map, as light words.
struct MirrorLight {
    struct Table {
        float roughness = 0;
        int edge = 0;             ///< number of texels per side, with the repeated border
        std::uint32_t first = 0;  ///< index of the first texel
    };
    std::vector<Table> tables;  ///< by ascending roughness, which begins at 0
    std::vector<std::uint32_t> texels;
    std::array<float, 3> towardsSun{0, 0, 1}, sunIrradiance{};  ///< irradiance 0: there is no sun
    float leastSunAlpha = 0;  ///< least width of a lobe: that of the sun's disc
    float least = 0;          ///< lower limit of the light
};

}  // namespace mfar
