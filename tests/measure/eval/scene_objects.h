#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "pipeline/composite/virtual_object.h"

#include <vector>

namespace mfar::eval {

/// Virtual objects of which half is hidden behind real objects of the scene. Empty for scenes
/// without such objects.
[[nodiscard]] std::vector<VirtualObject> sceneObjects(synthetic::Scene scene);

}  // namespace mfar::eval
