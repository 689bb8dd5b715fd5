#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <optional>
#include <span>

namespace mfar {

/// The corners of one tag in the world, and where they were seen.
struct CornerSet {
    std::array<Eigen::Vector3d, 4> world;     ///< [m]
    std::array<Eigen::Vector2d, 4> pixels;    ///< [px], distorted
    std::array<Eigen::Vector2d, 4> outwards;  ///< where a corner goes when the edges move out by 1
    double weight = 1;                        ///< of its squared error, 0: leave it out
};

/// For four corners in the order of TagDetection::corners, a convex quad.
[[nodiscard]] std::array<Eigen::Vector2d, 4>
outwardsOf(const std::array<Eigen::Vector2d, 4>& corners);

/// Sum of the squared reprojection errors of one set [px^2]; infinite when a corner is not in front
/// of the camera. `edgeShift` [px]: how far out all edges of the tags are seen, see refinePose.
[[nodiscard]] double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                                  const CameraModel& camera, double edgeShift = 0);

struct RefinedPose {
    RigidTransform T_world_camera;
    Matrix6 information;      ///< J^T J of a motion in the camera's own frame [px^2], what the edge
                              ///< shift takes of it taken off
    double squaredError = 0;  ///< weighted [px^2]
    double edgeShift = 0;     ///< [px]
};

/// Weight of the edge shift's square against a corner's: it stays zero.
inline constexpr double kNoEdgeShift = 1e12;

/// Levenberg-Marquardt from `start` to the next minimum of the weighted squared reprojection error.
/// Marquardt's scaling makes it independent of the unit of length. Nothing when a corner is behind
/// the camera at the start or the corners do not fix the pose.
///
/// The edges of all tags of a picture are seen a little too far out or in, by its blur, its gamma
/// and the printer's ink. With one tag that is no different from another distance; several tags
/// tell, and it is estimated with them unless `shiftWeight` forbids it.
[[nodiscard]] std::optional<RefinedPose> refinePose(std::span<const CornerSet> sets,
                                                    const RigidTransform& start,
                                                    const CameraModel& camera,
                                                    double shiftWeight = kNoEdgeShift);

/// Inverse of an information matrix whose rows may have any units; nothing when it is singular.
[[nodiscard]] std::optional<Matrix6> inverseOf(const Matrix6& information);

}  // namespace mfar
