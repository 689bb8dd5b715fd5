#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "pipeline/composite/virtual_object.h"

#include <vector>

namespace mfar::eval {

/// A sphere that is half hidden behind real objects of the scene. Empty for scenes other than
/// office and shelf.
[[nodiscard]] std::vector<VirtualObject> sceneObjects(synthetic::Scene scene);

}  // namespace mfar::eval
