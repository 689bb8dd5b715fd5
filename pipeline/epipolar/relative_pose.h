#pragma once

#include "base/se3.h"

#include <Eigen/Core>

#include <span>

namespace mfar {

/// A point of the scene in frame and still, as rays (x / z, y / z). `video` is in video camera
/// coordinates. `still` starts at the still camera's centre; the prior pose rotates it into the
/// orientation of the video camera.
struct RayMatch {
    Eigen::Vector2d video, still;
};

struct PosePrior {
    /// Moves points from the frame to the still, in the frame's orientation and in any unit of
    /// length.
    Eigen::Vector3d translation;
    /// Covariance of a small motion x of the video camera: T_still_video * exp(x).
    Matrix6 covariance;
};

struct PoseRefinement {
    bool accepted = false;
    RigidTransform motion;  ///< refined T_still_video = prior T_still_video * motion
    int patches = 0;
    int inliers = 0;
    /// Median distance of the matches from the epipolar lines of the prior pose and of the final
    /// pose [video px]. The final pose is the prior pose if the refinement was rejected.
    double normalBefore = 0;
    double normalAfter = 0;
};

/// Refines the relative pose by robust Gauss-Newton steps over matched rays. The inverse depth of
/// each match is eliminated. The prior determines the unknowns that the matches do not determine,
/// above all the length of the translation. If the prior's translation is zero, the matches must
/// agree with a pure rotation. `focal` is the number of video pixels per unit of ray.
///
/// The refinement is accepted only if `inliers` is large enough, also in relation to `patches`, and
/// if the median distance from the epipolar lines decreases clearly: sqrt(normalBefore^2 -
/// normalAfter^2) > kExactEnough, where normalAfter belongs to the refined pose.
/// Source: Hartley and Zisserman, 2nd ed., A6.3 (elimination); Beaton and Tukey 1974 (weights).
[[nodiscard]] PoseRefinement refineRelativePose(std::span<const RayMatch> matches,
                                                const PosePrior& prior, double focal);

/// A pose with an error below this [px] is not refined: the errors of the matches would add as much
/// error as the refinement removes.
inline constexpr double kExactEnough = 0.2;

/// Returns the covariance [rays^2] of a point's position in the still that follows from the prior's
/// covariance.
[[nodiscard]] Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior);

}  // namespace mfar
