#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <optional>
#include <span>

namespace mfar {

/// The corners of one tag in the world and in the picture.
struct CornerSet {
    std::array<Eigen::Vector3d, 4> world;     ///< [m]
    std::array<Eigen::Vector2d, 4> pixels;    ///< [px], distorted
    std::array<Eigen::Vector2d, 4> outwards;  ///< motion of a corner when the edges move out by 1
    double weight = 1;                        ///< of its squared error; 0: ignored
};

/// For four corners in the order of TagDetection::corners, a convex quad.
[[nodiscard]] std::array<Eigen::Vector2d, 4>
outwardsOf(const std::array<Eigen::Vector2d, 4>& corners);

/// Sum of the squared reprojection errors of one set [px^2]; infinite when a corner is not in front
/// of the camera. `edgeShift` [px]: how far out all edges of the tags appear, see refinePose.
[[nodiscard]] double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                                  const CameraModel& camera, double edgeShift = 0);

struct RefinedPose {
    RigidTransform T_world_camera;
    Matrix6 information;      ///< J^T J of a motion in the camera's own frame [px^2], reduced by
                              ///< the part that the edge shift explains
    double squaredError = 0;  ///< weighted [px^2]
    double edgeShift = 0;     ///< [px]
};

/// Weight of the edge shift's square, relative to a corner's, that keeps it at zero.
inline constexpr double kNoEdgeShift = 1e12;

/// Levenberg-Marquardt from `start` to the next minimum of the weighted squared reprojection error.
/// Marquardt's scaling makes it independent of the unit of length. Empty when a corner is behind
/// the camera at the start or the corners do not determine the pose.
///
/// The edges of all tags of a picture appear slightly too far out or in, due to blur, gamma and the
/// printer's ink. With one tag, this cannot be distinguished from another distance; with several
/// tags it can, and it is estimated unless `shiftWeight` prevents it.
[[nodiscard]] std::optional<RefinedPose> refinePose(std::span<const CornerSet> sets,
                                                    const RigidTransform& start,
                                                    const CameraModel& camera,
                                                    double shiftWeight = kNoEdgeShift);

/// Inverse of an information matrix whose rows may have any units; empty when it is singular.
[[nodiscard]] std::optional<Matrix6> inverseOf(const Matrix6& information);

}  // namespace mfar
