#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "pipeline/composite/virtual_object.h"

#include <vector>

namespace mfar::eval {

/// Virtual objects half behind real objects of a scene; empty if no suitable place is known.
[[nodiscard]] std::vector<VirtualObject> sceneObjects(synthetic::Scene scene);

}  // namespace mfar::eval
