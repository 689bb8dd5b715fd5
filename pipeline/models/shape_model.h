#pragma once

#include "pipeline/composite/virtual_object.h"
#include "pipeline/scene/scene.h"

namespace mfar {

/// A simple shape as a model, in metres: half rough, its checkerboard as a texture. A quad is seen
/// from both sides. Sizes along axes a shape does not have are ignored.
[[nodiscard]] Model shapeModel(const VirtualObject& object);

}  // namespace mfar
