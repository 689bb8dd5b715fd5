#pragma once

#include "pipeline/warp/silhouette_models.h"

#include <span>
#include <vector>

namespace mfar {

/// Returns one transform for each object number, from the layer's camera to the camera of an
/// earlier picture. It maps a point of the object from where it is now to where it was in the
/// picture. Entry 0 is for surfaces that do not move. Empty if no object moves.
/// `poses` are the objects' poses T_world_object in the picture. `objects` have their present
/// poses.
[[nodiscard]] std::vector<RigidTransform>
viewsOfObjects(const RigidTransform& T_world_view, std::span<const RigidTransform> poses,
               std::span<const SilhouetteModels::Object> objects,
               const RigidTransform& T_world_camera);

}  // namespace mfar
