#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Box around all objects in the world, empty without any vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

/// How far from the objects their shadows are looked for, in radii of the box around them.
inline constexpr double kShadowReach = 1;

/// The plane of the tag map, z = 0 in the world, around the objects, in cells of a few centimetres
/// or more. Empty where no object stands on it or above it, lower than kShadowReach radii.
[[nodiscard]] ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects);

/// The measured surface of the real scene around the objects: a vertex every few video pixels of
/// `where` that is known, two triangles between four of them unless depth jumps there. A vertex
/// that the plane of the tag map cannot be told from lies in it. `field` as the camera sees it from
/// T_world_video.
[[nodiscard]] ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                                         const RigidTransform& T_world_video,
                                         const PixelRect& where,
                                         const Eigen::AlignedBox3d& objects);

}  // namespace mfar
