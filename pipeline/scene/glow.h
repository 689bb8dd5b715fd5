#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Upper limit of glowReach().
inline constexpr double kMostGlowReach = 4;

/// Returns the distance up to which the light of glowing objects is visible on the real surface,
/// divided by the distance up to which shadows are expected. The result is from 1 (also if no
/// object glows visibly) to kMostGlowReach. The light is visible where it adds at least 0.5 %, half
/// a grey level, to the distant light.
[[nodiscard]] double glowReach(const Scene& scene);

}  // namespace mfar
