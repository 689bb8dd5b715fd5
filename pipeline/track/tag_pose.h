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
    RigidTransform T_world_tag;  ///< if soundMotion() refuses it, solveTagPose() ignores the tag
    std::array<Eigen::Vector2d, 4> corners;  ///< [distorted px], ordered like TagDetection::corners
};

/// A local minimum of the reprojection error of the tags.
struct CameraPose {
    RigidTransform T_world_camera;
    /// Covariance of a small motion x = (rotation, translation) in T_world_camera * exp(x).
    Matrix6 covariance = Matrix6::Zero();
    double squaredError = 0;  ///< sum over all corners of the used tags [px^2]
    int tags = 0;             ///< number of used tags
    double edgeShift = 0;     ///< shift of the tags' edges outwards [px]; 0 with one tag

    /// Root mean square of the corners' errors [px].
    [[nodiscard]] double rms() const;
};

/// The two poses from which a plane of tags looks nearly the same. `best` has the smaller error.
/// `other` is the second local minimum for the same tags, or empty if there is none.
struct CameraPoses {
    CameraPose best;
    std::optional<CameraPose> other;
    std::vector<bool> used;  ///< one entry per observation; false: unusable or an outlier
};

struct TagPoseOptions {
    /// Standard deviation of a corner's coordinates [px], from which the covariance of the pose is
    /// computed. If the corners fit worse than this, a larger value is used.
    double cornerSigma = 0.1;
    /// All tag edges of a picture are shifted outwards or inwards by a common distance. This is its
    /// standard deviation [px].
    double edgeShiftSigma = 0.1;
    /// A tag is ignored in three cases: the rms error of its corners is above farthestCorner [px],
    /// an edge is shorter than smallestEdge [px], or the tag is seen at grazingAngleDeg or more
    /// from its normal in at least one of its two planar solutions.
    double farthestCorner = 2;
    double smallestEdge = 8;
    double grazingAngleDeg = 80;
};

/// Computes the pose of the camera from the corners of one or more tags. First, the two planar
/// solutions (IPPE) of each tag are computed. From the solutions of the largest tags, the one that
/// fits all tags best is chosen. Then, tags that contradict it are ignored, and the reprojection
/// error in distorted pixels is minimised by Levenberg-Marquardt.
///
/// Returns nothing if no tag is usable, or if no pose was found whose rms error is at most
/// farthestCorner. A tag is unusable if a corner is NaN, infinite or outside the picture, if its
/// quad is tiny, not convex, seen at a grazing angle or seen from behind, or if its size or
/// T_world_tag is invalid. Results are never NaN. Lengths may have any unit.
[[nodiscard]] std::optional<CameraPoses> solveTagPose(std::span<const TagObservation> tags,
                                                      const CameraModel& camera,
                                                      const TagPoseOptions& options = {});

/// Returns the two possible poses T_camera_square of a square with the corners (-1, -1) to (1, 1).
/// Its corners are seen along the rays (x/z, y/z), in the order of kTagCorners. The pose with the
/// smaller error comes first. Returns nothing if the corners are degenerate. Source: IPPE, Collins
/// and Bartoli, "Infinitesimal Plane-Based Pose Estimation", IJCV 2014.
[[nodiscard]] std::optional<std::array<RigidTransform, 2>>
planarPoses(const std::array<Eigen::Vector2d, 4>& rays);

}  // namespace mfar
