#pragma once

#include "pipeline/scene/scene.h"

namespace mfar::test {

/// Throws std::runtime_error if the model violates a rule that scene.h states.
void requireSoundModel(const Model& model);

}  // namespace mfar::test
