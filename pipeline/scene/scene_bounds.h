#pragma once

#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Returns the bounds of the object in the given frame.
[[nodiscard]] Eigen::AlignedBox3d boundsIn(const RigidTransform& T_frame_world,
                                           const SceneObject& object);

/// Returns the bounds of all objects in world coordinates. They are empty if the scene has no
/// vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

}  // namespace mfar
