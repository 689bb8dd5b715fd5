#pragma once

#include "pipeline/geometry.h"
#include "pipeline/track/se3.h"

#include <array>
#include <optional>
#include <span>

namespace mfar {

/// The corners of one tag in the world, and where they were seen.
struct CornerSet {
    std::array<Eigen::Vector3d, 4> world;   ///< [m]
    std::array<Eigen::Vector2d, 4> pixels;  ///< [px], distorted
    double weight = 1;                      ///< of its squared error, 0: leave it out
};

/// Sum of the squared reprojection errors of one set [px^2]; infinite when a corner is not in front
/// of the camera.
[[nodiscard]] double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                                  const CameraModel& camera);

struct RefinedPose {
    RigidTransform T_world_camera;
    Matrix6 information;      ///< J^T J of a motion in the camera's own frame [px^2]
    double squaredError = 0;  ///< weighted [px^2]
};

/// Levenberg-Marquardt from `start` to the next minimum of the weighted squared reprojection error.
/// Marquardt's scaling makes it independent of the unit of length. Nothing when a corner is behind
/// the camera at the start or the corners do not fix the pose.
[[nodiscard]] std::optional<RefinedPose>
refinePose(std::span<const CornerSet> sets, const RigidTransform& start, const CameraModel& camera);

/// Inverse of an information matrix whose rows may have any units; nothing when it is singular.
[[nodiscard]] std::optional<Matrix6> inverseOf(const Matrix6& information);

}  // namespace mfar
