#pragma once

#include "pipeline/scene/scene.h"

namespace mfar::test {

/// Throws std::runtime_error for a model that does not satisfy scene.h.
void requireSoundModel(const Model& model);

}  // namespace mfar::test
