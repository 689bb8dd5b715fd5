#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene.h"

#include <Eigen/Geometry>

namespace mfar {

/// Bounds of all objects in the world, empty if there is no vertex.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const Scene& scene);

/// How far around the objects their shadows are expected, in radii of the box around them.
inline constexpr double kShadowReach = 1;

/// The plane of the tag map, z = 0 in the world, around the objects, in cells of a few centimetres
/// or more. Empty unless an object stands on the plane or less than kShadowReach radii above it.
[[nodiscard]] ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects);

/// The measured surface of the real scene around the objects: a vertex every few known video pixels
/// of `where`, and two triangles between four vertices unless depth jumps there. Vertices that
/// cannot be distinguished from the plane of the tag map are put on it. `field`: as seen by the
/// camera from T_world_video.
[[nodiscard]] ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                                         const RigidTransform& T_world_video,
                                         const PixelRect& where,
                                         const Eigen::AlignedBox3d& objects);

}  // namespace mfar
