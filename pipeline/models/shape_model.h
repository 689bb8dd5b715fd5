#pragma once

#include "pipeline/composite/virtual_object.h"
#include "pipeline/scene/scene.h"

namespace mfar {

/// Returns a simple shape as a model in metres, with medium roughness and its checkerboard as a
/// texture. A quad is visible from both sides. Sizes along axes that the shape does not have are
/// ignored.
[[nodiscard]] Model shapeModel(const VirtualObject& object);

}  // namespace mfar
