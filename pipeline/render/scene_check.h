#pragma once

#include "pipeline/scene/scene.h"

namespace mfar {

/// Throws std::invalid_argument if the scene violates a limit that is documented in scene.h: for
/// example, if a model is null, a number is not finite, or an index is out of range. The message
/// names the first violation.
void validate(const Scene& scene);

}  // namespace mfar
