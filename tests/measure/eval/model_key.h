#pragma once

#include "pipeline/scene/scene.h"

#include <cstdint>

namespace mfar::eval {

/// Hash (FNV-1a, 64 bit) of everything in a model that a picture shows: meshes, motion, materials
/// and textures. Models whose keys differ are different.
[[nodiscard]] std::uint64_t modelKey(const Model& model);

}  // namespace mfar::eval
