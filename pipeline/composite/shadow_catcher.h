#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/scene/scene_bounds.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace mfar {

/// Shadows are expected up to this distance from the objects' bounding box, in units of half the
/// box's diagonal. Light of glowing objects is expected up to glowReach() times this distance.
inline constexpr double kShadowReach = 1;
/// A plane has this number of columns and of rows of cells. Each cell is two triangles.
inline constexpr int kPlaneCells = 8;

/// Returns the part of the tag map's plane (z = 0 in the world) below and around the objects'
/// bounding box. This part extends beyond the box by `reach` times half of the box's diagonal. The
/// result is empty if all objects are below the plane, or farther above it than this distance.
[[nodiscard]] ShadowCatcher planeCatcher(const Eigen::AlignedBox3d& objects,
                                         double reach = kShadowReach, int cells = kPlaneCells);

/// A plane of the real scene: z = 0 of its frame.
struct GroundPlane {
    RigidTransform T_world_plane;
    Eigen::AlignedBox3d objects;  ///< bounds, in the plane's frame, of the objects that shade it
    double reach = kShadowReach;  ///< extent beyond `objects` [half of its diagonal]
};

/// Returns the planes that objects are expected to shade. The first plane is that of the tag map;
/// it belongs to all objects. Each other plane is the ground of the objects that stand on it
/// (SceneObject::T_world_ground). Grounds that hardly differ around the objects count as one plane.
[[nodiscard]] std::vector<GroundPlane> groundPlanes(const Scene& scene);

/// Returns the parts of the planes below and around their objects, as planeCatcher() does.
[[nodiscard]] ShadowCatcher planeCatcher(std::span<const GroundPlane> planes,
                                         int cells = kPlaneCells);

/// Returns the measured surface of the real scene near the objects: inside their bounds, extended
/// on all sides by planes[0].reach times half of the diagonal. Its vertices are video pixels of
/// `where` with known depth, a few pixels apart. Four neighbours are joined by two triangles unless
/// depth jumps between them. Vertices that cannot be distinguished from one of the planes are moved
/// onto it. planes[0] must be the plane of the tag map with the bounds of all objects, as
/// groundPlanes() returns it.
[[nodiscard]] ShadowCatcher depthCatcher(const InverseDepthField& field, const CameraModel& video,
                                         const RigidTransform& T_world_video,
                                         const PixelRect& where,
                                         std::span<const GroundPlane> planes);

/// Adds those triangles of the planes that have no vertex inside the video picture. So shadows
/// outside of the view of a depthCatcher() fall onto the planes.
void addUnseen(ShadowCatcher& measured, std::span<const GroundPlane> planes,
               const CameraModel& video, const RigidTransform& T_world_video);

}  // namespace mfar
