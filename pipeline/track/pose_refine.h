#pragma once

#include "base/geometry.h"
#include "base/se3.h"

#include <array>
#include <optional>
#include <span>

namespace mfar {

/// Corners of a tag: their positions in the world [m] and in the distorted picture [px].
struct CornerSet {
    std::array<Eigen::Vector3d, 4> world;
    std::array<Eigen::Vector2d, 4> pixels;
    std::array<Eigen::Vector2d, 4> outwards;  ///< corner shift [px] if all edges move out by 1 px
    double weight = 1;  ///< weight of the squared error; 0: the tag is ignored
};

/// Computes CornerSet::outwards. The corners must be a convex quad in the order of
/// TagDetection::corners.
[[nodiscard]] std::array<Eigen::Vector2d, 4>
outwardsOf(const std::array<Eigen::Vector2d, 4>& corners);

/// Returns the sum of the squared reprojection errors of one tag [px^2]. If a corner is not in
/// front of the camera, the sum is infinite. For `edgeShift` [px], see refinePose().
[[nodiscard]] double squaredError(const CornerSet& set, const RigidTransform& T_camera_world,
                                  const CameraModel& camera, double edgeShift = 0);

struct RefinedPose {
    RigidTransform T_world_camera;
    /// Sum of w J^T J over the tags, where w is CornerSet::weight, and J is the derivative of the
    /// corners' positions [px] with respect to a small motion in camera coordinates. The
    /// information that is lost because the edge shift is unknown has been subtracted.
    Matrix6 information;
    double squaredError = 0;  ///< weighted sum over all tags [px^2]
    double edgeShift = 0;     ///< [px]; positive: outwards
};

/// With this `shiftWeight`, refinePose() estimates an edge shift of zero.
inline constexpr double kNoEdgeShift = 1e12;

/// Minimises the weighted squared reprojection error by Levenberg-Marquardt, from `start` to the
/// nearest local minimum. Marquardt's scaling makes the result independent of the unit of length.
/// Returns nothing if a corner is not in front of the camera at the start, or if a number becomes
/// infinite or NaN. If the corners do not determine the pose, inverseOf(information) returns
/// nothing.
///
/// Blur, gamma and the printer's ink move the edges of all tags in a picture slightly outwards or
/// inwards, by a common edge shift. With one tag, an edge shift looks the same as another distance
/// of the tag. With several tags, it is estimated together with the pose. `shiftWeight` is the
/// weight of the squared edge shift, relative to the weight of a corner.
[[nodiscard]] std::optional<RefinedPose> refinePose(std::span<const CornerSet> sets,
                                                    const RigidTransform& start,
                                                    const CameraModel& camera,
                                                    double shiftWeight = kNoEdgeShift);

/// Returns the inverse of an information matrix. Its rows may have different units. Returns nothing
/// if the matrix is singular.
[[nodiscard]] std::optional<Matrix6> inverseOf(const Matrix6& information);

}  // namespace mfar
