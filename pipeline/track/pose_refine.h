#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <optional>
#include <span>

namespace mfar {
/// Corners of a tag in the world [m] and in the distorted picture [px].

struct CornerSet {
    std::array<Eigen::Vector3d, 4> world;
    std::array<Eigen::Vector2d, 4> pixels;
    std::array<Eigen::Vector2d, 4> outwards;  ///< motion of each corner [px] if all edges move
                                              ///< outwards by 1 px
    double weight = 1;  ///< weight of the squared error; 0: the tag is ignored
};

/// Computes CornerSet::outwards. The corners must be a convex quad in the order of
/// TagDetection::corners.
[[nodiscard]] std::array<Eigen::Vector2d, 4>
outwardsOf(const std::array<Eigen::Vector2d, 4>& corners);

/// Returns the sum of the squared reprojection errors of one tag [px^2]. Infinite if a corner is
/// not in front of the camera. `edgeShift` [px]: see refinePose().
[[nodiscard]] double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                                  const CameraModel& camera, double edgeShift = 0);

struct RefinedPose {
    RigidTransform T_world_camera;
    /// J^T J, where J is the derivative of the corners' positions [px] with respect to a small
    /// motion in camera coordinates. The part that an unknown edge shift could explain is
    /// subtracted.
    Matrix6 information;
    double squaredError = 0;
    double edgeShift = 0;
};

/// A `shiftWeight` for refinePose() that is so large that the estimated edge shift is zero.
inline constexpr double kNoEdgeShift = 1e12;

/// Minimises the weighted squared reprojection error by Levenberg-Marquardt, from `start` to the
/// nearest local minimum. Marquardt's scaling makes the result independent of the unit of length.
/// Returns nothing if a corner is behind the camera at the start or if the corners do not determine
/// the pose.
///
/// Blur, gamma and the printer's ink move the edges of all tags in a picture slightly out or in.
/// With one tag, this edge shift looks the same as a change of the tag's distance. With several
/// tags, the edge shift is estimated. `shiftWeight` is the weight of its square, relative to a
/// corner's weight.
[[nodiscard]] std::optional<RefinedPose> refinePose(std::span<const CornerSet> sets,
                                                    const RigidTransform& start,
                                                    const CameraModel& camera,
                                                    double shiftWeight = kNoEdgeShift);

/// Returns the inverse of an information matrix whose rows may have different units, or nothing if
/// the matrix is singular.
[[nodiscard]] std::optional<Matrix6> inverseOf(const Matrix6& information);

}  // namespace mfar
