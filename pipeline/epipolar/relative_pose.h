#pragma once

#include "base/se3.h"

#include <Eigen/Core>

#include <span>

namespace mfar {

/// A point of the scene seen by the frame and the still, as rays (x / z, y / z). `video`: in the
/// video camera's coordinates. `still`: from the still camera's centre, in the orientation that the
/// prior gives the video camera.
struct RayMatch {
    Eigen::Vector2d video, still;
};

/// Prior of T_still_video, before matching.
struct PosePrior {
    /// Moves points from the frame to the still, in the frame's orientation; its unit of length is
    /// free.
    Eigen::Vector3d translation;
    /// Covariance of a small motion x in the video camera's own frame, T_still_video * exp(x).
    Matrix6 covariance;
};

struct PoseRefinement {
    bool accepted = false;
    RigidTransform motion;    ///< refined T_still_video = prior T_still_video * motion
    int patches = 0;          ///< number of matches
    int inliers = 0;          ///< number of matches that the solution explains
    double normalBefore = 0;  ///< median distance from the prior's epipolar lines [video px]
    double normalAfter = 0;   ///< the same for the final pose: refined if accepted, else the prior
};

/// Refines the relative pose by robust Gauss-Newton over matched rays; each match's inverse depth
/// is eliminated. The prior holds the directions that the matches do not constrain, above all the
/// length of the translation. Without a translation the matches must agree with a pure rotation.
/// `focal`: video pixels per unit of ray.
///
/// Rejected when there are too few matches, when too many of them are outliers, or when the prior's
/// share in their distance from the epipolar lines is below kExactEnough.
/// Source: Hartley and Zisserman, 2nd ed., A6.3 (elimination); Beaton and Tukey 1974 (weights).
[[nodiscard]] PoseRefinement refineRelativePose(std::span<const RayMatch> matches,
                                                const PosePrior& prior, double focal);

/// A pose with this error needs no refinement: the matches' own errors would move it as far [px].
inline constexpr double kExactEnough = 0.2;

/// Covariance of a point's place in the still [rays^2] that results from the prior's covariance.
[[nodiscard]] Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior);

}  // namespace mfar
