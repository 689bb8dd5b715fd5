#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Throws std::invalid_argument that names the first thing about the scene that is not as its
/// declaration says: null models, numbers that are not finite, indices out of range.
void validate(const Scene& scene);

}  // namespace mfar
