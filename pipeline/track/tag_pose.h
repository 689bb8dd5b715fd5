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

/// A tag in the picture with a known pose in the world.
struct TagObservation {
    double size = 0;                         ///< edge of the black square [m]
    RigidTransform T_world_tag;              ///< tag frame: x right, y down, z into the surface
    std::array<Eigen::Vector2d, 4> corners;  ///< [px], distorted, order of TagDetection::corners
};

/// One local minimum of the reprojection error.
struct CameraPose {
    RigidTransform T_world_camera;
    /// Covariance of a small motion in the camera's own frame, T_world_camera * exp(rotation,
    /// translation).
    Matrix6 covariance = Matrix6::Zero();
    double squaredError = 0;  ///< sum over all corners of the tags used [px^2]
    int tags = 0;             ///< tags used
    double edgeShift = 0;     ///< how far out the tags' edges appear [px]; 0 with one tag

    /// Root mean square over the corners [px].
    [[nodiscard]] double rms() const;
};

/// A plane of tags looks nearly the same from two poses. `best` has the smaller error; `other` is
/// the second minimum over the same tags, if there is one, whatever its error.
struct CameraPoses {
    CameraPose best;
    std::optional<CameraPose> other;
    std::vector<bool> used;  ///< per observation: false if it was unusable or an outlier
};

struct TagPoseOptions {
    /// Standard deviation of a corner's coordinates [px]: a lower limit for the covariance, which
    /// grows where the corners fit worse.
    double cornerSigma = 0.1;
    /// Standard deviation of the common shift of all edges of a picture's tags [px].
    double edgeShiftSigma = 0.1;
    double farthestCorner = 2;    ///< a tag with larger errors of its corners is left out, rms [px]
    double smallestEdge = 8;      ///< a tag with a shorter edge is left out [px]
    double grazingAngleDeg = 80;  ///< a tag seen at a larger angle to its normal is left out
};

/// The pose of the camera from the corners of one or more tags. Computes both planar solutions
/// (IPPE) of every tag, takes the one that fits all tags best, leaves out contradicting tags, and
/// minimises the reprojection error in distorted pixels by Levenberg-Marquardt. Empty when no tag
/// is usable: NaN or infinite corners, corners outside the picture, quads that are tiny, not
/// convex, seen at a grazing angle or from behind. Results are never NaN. Lengths may be in any
/// unit.
[[nodiscard]] std::optional<CameraPoses> solveTagPose(std::span<const TagObservation> tags,
                                                      const CameraModel& camera,
                                                      const TagPoseOptions& options = {});

/// The two poses of a plane that map the square (-1, -1) .. (1, 1) of its x and y to four rays
/// (x/z, y/z), corners in the order of kTagCorners; the better one first. Empty for degenerate
/// corners. IPPE, Collins and Bartoli, "Infinitesimal Plane-Based Pose Estimation", IJCV 2014.
[[nodiscard]] std::optional<std::array<RigidTransform, 2>>
planarPoses(const std::array<Eigen::Vector2d, 4>& rays);

}  // namespace mfar
