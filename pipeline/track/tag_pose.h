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

/// A tag in the picture whose place in the world is known.
struct TagObservation {
    double size = 0;                         ///< edge of the black square [m]
    RigidTransform T_world_tag;              ///< tag frame: x right, y down, z into the surface
    std::array<Eigen::Vector2d, 4> corners;  ///< [px], distorted, order of TagDetection::corners
};

/// One local minimum of the reprojection error.
struct CameraPose {
    RigidTransform T_world_camera;
    /// Of a small motion in the camera's own frame, T_world_camera * exp(rotation, translation).
    Matrix6 covariance = Matrix6::Zero();
    double squaredError = 0;  ///< sum over all corners of the tags used [px^2]
    int tags = 0;             ///< tags used
    double edgeShift = 0;     ///< how far out the tags' edges are seen; 0 with one tag [px]

    /// Root mean square over the corners [px].
    [[nodiscard]] double rms() const;
};

/// A plane of tags looks nearly the same from two places. `best` has the smaller error, `other` is
/// the second minimum over the same tags where there is one, whatever its error.
struct CameraPoses {
    CameraPose best;
    std::optional<CameraPose> other;
    std::vector<bool> used;  ///< per observation: false where it was unfit or contradicted the rest
};

struct TagPoseOptions {
    /// Standard deviation of a corner's coordinates [px]. The covariance never claims less than it,
    /// and more where the corners fit worse.
    double cornerSigma = 0.1;
    /// Standard deviation of how far out or in all edges of a picture's tags are seen [px].
    double edgeShiftSigma = 0.1;
    double farthestCorner = 2;    ///< a tag whose corners miss by more is left out, rms [px]
    double smallestEdge = 8;      ///< a tag with a shorter edge is left out [px]
    double grazingAngleDeg = 80;  ///< a tag seen from farther off its normal is left out
};

/// The pose of the camera from the corners of one or more tags: both planar solutions (IPPE) of
/// every tag, the best of them over all tags with tags that contradict it left out, and from there
/// Levenberg-Marquardt on the reprojection error in distorted pixels. Nothing when no tag is fit:
/// NaN or infinite corners, corners outside the picture, quads that are tiny, not convex, seen at a
/// grazing angle or from behind. No result is ever NaN. Lengths may be in any unit.
[[nodiscard]] std::optional<CameraPoses> solveTagPose(std::span<const TagObservation> tags,
                                                      const CameraModel& camera,
                                                      const TagPoseOptions& options = {});

/// The two poses of a plane that map the square (-1, -1) .. (1, 1) of its x and y to four rays
/// (x/z, y/z), corners in the order of kTagCorners; the one that fits better first. Nothing for
/// degenerate corners. IPPE, Collins and Bartoli, "Infinitesimal Plane-Based Pose Estimation",
/// IJCV 2014.
[[nodiscard]] std::optional<std::array<RigidTransform, 2>>
planarPoses(const std::array<Eigen::Vector2d, 4>& rays);

}  // namespace mfar
