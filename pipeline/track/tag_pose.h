#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/track/tag_detector.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace mfar {

/// A tag in the picture whose pose in the world is known. Tag coordinates: x right, y down, z into
/// the surface. `size` is the side of the square between the corners [m].
struct TagObservation {
    double size = 0;
    RigidTransform T_world_tag;  ///< solveTagPose() ignores the tag if soundMotion() refuses this
    std::array<Eigen::Vector2d, 4> corners;  ///< in the distorted picture [px], in the order of
                                             ///< TagDetection::corners
};

/// A local minimum of the reprojection error of the tags.
struct CameraPose {
    RigidTransform T_world_camera;
    /// Covariance of a small motion in camera coordinates: T_world_camera * exp(rotation,
    /// translation).
    Matrix6 covariance = Matrix6::Zero();
    double squaredError = 0;
    int tags = 0;
    double edgeShift = 0;  ///< distance by which the tags' edges appear too far out [px]; 0 with
                           ///< one tag

    /// Root mean square of the corners' errors [px].
    [[nodiscard]] double rms() const;
};

/// The two poses from which a plane of tags looks nearly the same. `best` has the smaller error.
/// `other` is the second local minimum for the same tags, if there is one.
struct CameraPoses {
    CameraPose best;
    std::optional<CameraPose> other;
    std::vector<bool> used;  ///< for each observation; false: unusable or an outlier
};

struct TagPoseOptions {
    /// Standard deviation of a corner's coordinates [px] from which the covariance is computed. If
    /// the corners fit worse, a larger value is used.
    double cornerSigma = 0.1;
    /// Standard deviation of the shift [px] that all tag edges of a picture have in common.
    double edgeShiftSigma = 0.1;
    /// A tag is ignored if the rms error of its corners is above farthestCorner [px], if an edge is
    /// below smallestEdge [px], or if the angle between view and normal is above grazingAngleDeg.
    double farthestCorner = 2;
    double smallestEdge = 8;
    double grazingAngleDeg = 80;
};

/// Computes the pose of the camera from the corners of one or more tags. First, both planar
/// solutions (IPPE) of each tag are computed. Among the solutions of the largest tags, the one that
/// fits all tags best is selected. Then tags that contradict it are ignored, and the reprojection
/// error in distorted pixels is minimised by Levenberg-Marquardt.
///
/// Returns nothing if no tag is usable. A tag is unusable if a corner is NaN, infinite or outside
/// the picture, or if the quad is tiny, not convex, seen at a grazing angle or seen from behind.
/// Results are never NaN. Lengths may have any unit.
[[nodiscard]] std::optional<CameraPoses> solveTagPose(std::span<const TagObservation> tags,
                                                      const CameraModel& camera,
                                                      const TagPoseOptions& options = {});

/// Returns the two poses of a plane whose square from (-1, -1) to (1, 1) is seen along the rays
/// (x/z, y/z) of its corners, in the order of kTagCorners. The pose with the smaller error comes
/// first. Returns nothing if the corners are degenerate. Source: IPPE, Collins and Bartoli,
/// "Infinitesimal Plane-Based Pose Estimation", IJCV 2014.
[[nodiscard]] std::optional<std::array<RigidTransform, 2>>
planarPoses(const std::array<Eigen::Vector2d, 4>& rays);

}  // namespace mfar
