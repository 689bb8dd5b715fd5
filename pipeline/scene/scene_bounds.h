#pragma once

#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Returns the bounds of the object in the given frame; of a moving object, its bounds at any time.
[[nodiscard]] Eigen::AlignedBox3d boundsIn(const RigidTransform& T_frame_world,
                                           const SceneObject& object);

/// Returns the bounds of all objects in world coordinates, at any time. They are empty if the scene
/// has no vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

}  // namespace mfar
