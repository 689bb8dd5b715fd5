#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Upper limit of glowReach().
inline constexpr double kMostGlowReach = 4;

/// Returns how much farther than shadows the light of glowing objects is visible on the real
/// surface, as a factor from 1 (no object glows visibly) to kMostGlowReach. The light is visible up
/// to the distance at which it adds 0.5 %, half a grey level, to the distant light.
[[nodiscard]] double glowReach(const Scene& scene);

}  // namespace mfar
