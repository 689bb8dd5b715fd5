#pragma once

#include "pipeline/scene/scene.h"

#include <cstdint>

namespace mfar::eval {

/// Hash (FNV-1a, 64 bit) of everything in a scene that a picture shows: models, poses, motion,
/// materials, textures, light and the shadow catcher. Scenes whose keys differ are different.
[[nodiscard]] std::uint64_t sceneKey(const Scene& scene);

}  // namespace mfar::eval
