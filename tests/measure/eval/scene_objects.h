#pragma once

#include "hal/virtual/synthetic_scene.h"
#include "pipeline/composite/virtual_object.h"

#include <vector>

namespace mfar::eval {

/// Virtual objects that real objects of the scene occlude by half. Empty if no suitable place in
/// the scene is known.
[[nodiscard]] std::vector<VirtualObject> sceneObjects(synthetic::Scene scene);

}  // namespace mfar::eval
