#pragma once

#include "pipeline/scene/scene.h"

namespace mfar::test {

/// Throws std::runtime_error unless the model is what scene.h says of one.
void requireSoundModel(const Model& model);

}  // namespace mfar::test
