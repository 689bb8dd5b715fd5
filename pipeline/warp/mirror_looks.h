#pragma once

#include "base/mirror_light.h"

#include <array>
#include <cstddef>

namespace mfar {

/// Describes how a surface of one roughness mirrors distant light. The light is interpolated
/// between the tables `table` and `table` + 1 of MirrorLight. `share` is the weight of table
/// `table` + 1.
struct MirrorLook {
    std::size_t table = 0;
    float share = 0;
    float alpha = 0;  ///< GGX parameter, at least MirrorLight::leastSunAlpha
};
inline constexpr std::size_t kRoughnesses = 256;
/// Returns the looks of all roughnesses. The index is the roughness byte of GlossWords.
[[nodiscard]] std::array<MirrorLook, kRoughnesses> mirrorLooks(const MirrorLight& mirrors);

}  // namespace mfar
