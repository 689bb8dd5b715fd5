#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Upper limit of glowReach().
inline constexpr double kMostGlowReach = 4;

/// Returns the distance up to which the light of glowing objects is visible on the real surface
/// [m]. 0 if no object glows. The light is visible where it adds at least 0.5 %, half a grey level,
/// to the distant light.
[[nodiscard]] double glowDistance(const Scene& scene);
/// Returns `glowDistance` divided by the distance up to which shadows are expected, which is the
/// `diagonal` of the objects' common box [m]. The result is from 1 to kMostGlowReach.
[[nodiscard]] double glowReach(double glowDistance, double diagonal);
/// For moving objects, the common box contains the whole motion.
[[nodiscard]] double glowReach(const Scene& scene);

}  // namespace mfar
