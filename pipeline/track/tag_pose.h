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

/// A tag in the picture whose pose in the world is known.
struct TagObservation {
    double size = 0;                         ///< edge of the black square [m]
    RigidTransform T_world_tag;              ///< tag frame: x right, y down, z into the surface
    std::array<Eigen::Vector2d, 4> corners;  ///< [px], distorted; order of TagDetection::corners
};

/// A local minimum of the reprojection error.
struct CameraPose {
    RigidTransform T_world_camera;
    /// Covariance of a small motion in the camera's own frame: T_world_camera * exp(rotation,
    /// translation).
    Matrix6 covariance = Matrix6::Zero();
    double squaredError = 0;  ///< sum over all corners of the tags used [px^2]
    int tags = 0;             ///< number of tags used
    double edgeShift = 0;     ///< distance by which edges appear too far out [px]; 0 with one tag

    /// Root mean square of the corners' errors [px].
    [[nodiscard]] double rms() const;
};

/// A plane of tags looks nearly the same from two poses. `best` has the smaller error. `other` is
/// the second local minimum for the same tags, if there is one; its error may be of any size.
struct CameraPoses {
    CameraPose best;
    std::optional<CameraPose> other;
    std::vector<bool> used;  ///< for each observation: false if it was unusable or an outlier
};

struct TagPoseOptions {
    /// Standard deviation of a corner's coordinates [px]. It is a lower limit for the covariance,
    /// which is larger if the corners fit worse.
    double cornerSigma = 0.1;
    /// Standard deviation of the shift [px] that all tag edges of a picture have in common.
    double edgeShiftSigma = 0.1;
    double farthestCorner = 2;    ///< a tag with a larger rms error of its corners is ignored [px]
    double smallestEdge = 8;      ///< a tag with a shorter edge is ignored [px]
    double grazingAngleDeg = 80;  ///< a tag seen at a larger angle from its normal is ignored
};

/// Computes the pose of the camera from the corners of one or more tags. It computes both planar
/// solutions (IPPE) of every tag and takes the solution that fits all tags best. Then it ignores
/// tags that contradict this solution, and minimises the reprojection error in distorted pixels by
/// Levenberg-Marquardt.
/// Empty if no tag is usable. Tags are unusable if corners are NaN, infinite or outside the
/// picture, or if the quad is tiny, not convex, seen at a grazing angle or seen from behind.
/// Results are never NaN. Lengths may have any unit.
[[nodiscard]] std::optional<CameraPoses> solveTagPose(std::span<const TagObservation> tags,
                                                      const CameraModel& camera,
                                                      const TagPoseOptions& options = {});

/// The two poses of a plane that project the square from (-1, -1) to (1, 1) of the plane's x and y
/// to four rays (x/z, y/z). The corners are in the order of kTagCorners. The better pose comes
/// first. Empty if the corners are degenerate. Source: IPPE, Collins and Bartoli, "Infinitesimal
/// Plane-Based Pose Estimation", IJCV 2014.
[[nodiscard]] std::optional<std::array<RigidTransform, 2>>
planarPoses(const std::array<Eigen::Vector2d, 4>& rays);

}  // namespace mfar
