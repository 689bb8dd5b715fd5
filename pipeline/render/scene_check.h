#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Checks the scene's documented limits: null models, numbers that are not finite, indices out of
/// range. Throws std::invalid_argument that names the first violation.
void validate(const Scene& scene);

}  // namespace mfar
