#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Returns the bounds of all objects in the world, empty if the scene has no vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

/// Shadows are expected within this distance of the box around the objects, in radii of the box.
inline constexpr double kShadowReach = 1;

/// Returns the part of the tag map's plane (z = 0 in the world) around the objects. Empty if all
/// objects are below the plane or more than kShadowReach radii above it.
[[nodiscard]] ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects);

/// Returns the measured surface of the real scene around the objects. Video pixels of `where` with
/// known depth become vertices, a few pixels apart. Four neighbouring vertices are joined by two
/// triangles unless depth jumps between them. Vertices that cannot be distinguished from the plane
/// of the tag map are moved onto it. `field`: depth seen by the camera from T_world_video.
[[nodiscard]] ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                                         const RigidTransform& T_world_video,
                                         const PixelRect& where,
                                         const Eigen::AlignedBox3d& objects);

}  // namespace mfar
