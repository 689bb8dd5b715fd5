#pragma once

#include "pipeline/warp/silhouette_models.h"

#include <span>
#include <vector>

namespace mfar {

/// Returns for each object number the transform from the layer's camera to a picture's camera. It
/// maps a point of the object at its present pose to the same point at the pose in the picture.
/// Entry 0 is for surfaces that do not move. Empty if no object moves.
/// `poses` are the objects' poses in the picture, T_world_object. `objects` have their present
/// poses.
[[nodiscard]] std::vector<RigidTransform>
viewsOfObjects(const RigidTransform& T_world_view, std::span<const RigidTransform> poses,
               std::span<const SilhouetteModels::Object> objects,
               const RigidTransform& T_world_camera);

}  // namespace mfar
