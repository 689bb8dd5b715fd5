#pragma once

#include "pipeline/composite/virtual_object.h"
#include "pipeline/scene/scene.h"

namespace mfar {

/// Returns a simple shape as a model in metres, with medium roughness. Its checkerboard is a
/// texture, or a colour if both colours are equal. A quad is visible from both sides. It has no
/// extent along z, but object.size.z() must not be 0.
[[nodiscard]] Model shapeModel(const VirtualObject& object);

}  // namespace mfar
