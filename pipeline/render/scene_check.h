#pragma once

#include "pipeline/scene/scene.h"

#include <cstddef>

namespace mfar {

inline constexpr std::size_t kMostSceneObjects = 250;

/// Throws std::invalid_argument if the scene violates a limit on which the path tracer relies (see
/// scene.h). The message names the first violation.
void validate(const Scene& scene);

}  // namespace mfar
