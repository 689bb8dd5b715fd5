#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Returns the bounds of all objects in world coordinates. They are empty if the scene has no
/// vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

/// Shadows are expected up to this distance from the objects' bounding box, in units of half the
/// box's diagonal.
inline constexpr double kShadowReach = 1;

/// Returns the part of the tag map's plane (z = 0 in the world) below and around the objects'
/// bounding box. Empty if all objects are below the plane, or so far above it that no shadow is
/// expected on it (kShadowReach).
[[nodiscard]] ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects);

/// Returns the measured surface of the real scene around the objects. Its vertices are video pixels
/// of `where` with known depth, a few pixels apart. Four neighbours are joined by two triangles
/// unless depth jumps between them. Vertices that cannot be distinguished from the plane of the tag
/// map are moved onto it. `objects` is the bounding box of the objects.
[[nodiscard]] ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                                         const RigidTransform& T_world_video,
                                         const PixelRect& where,
                                         const Eigen::AlignedBox3d& objects);

}  // namespace mfar
