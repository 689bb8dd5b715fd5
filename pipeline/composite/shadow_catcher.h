#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Returns the bounds of all objects of the scene, in the world; empty if the scene has no vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

/// Shadows are expected up to this distance from the bounding box of the objects, in units of the
/// box's radius (half its diagonal).
inline constexpr double kShadowReach = 1;

/// Returns the part of the tag map's plane (z = 0 in the world) in and around the bounding box
/// `objects`. Empty if all objects are below the plane or more than kShadowReach radii above it.
[[nodiscard]] ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects);

/// Returns the measured surface of the real scene around the objects. Video pixels of `where` with
/// known depth become vertices, a few pixels apart. Four neighbouring vertices are joined by two
/// triangles unless depth jumps between them. Vertices that cannot be distinguished from the plane
/// of the tag map are moved onto it. `field`: depth of the real scene, seen by the camera at the
/// pose T_world_video. `objects`: bounding box of the objects.
[[nodiscard]] ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                                         const RigidTransform& T_world_video,
                                         const PixelRect& where,
                                         const Eigen::AlignedBox3d& objects);

}  // namespace mfar
