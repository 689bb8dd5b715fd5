#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Throws std::invalid_argument that names the first violation of the scene's documented limits:
/// null models, numbers that are not finite, indices out of range.
void validate(const Scene& scene);

}  // namespace mfar
