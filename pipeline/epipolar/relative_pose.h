#pragma once

#include "base/se3.h"

#include <Eigen/Core>

#include <span>

namespace mfar {

/// A point of the scene that the frame and the still show, as two rays (x / z, y / z). `video` is
/// in the video camera's coordinates. `still` starts at the still camera's centre, in the
/// orientation of the video camera according to the prior.
struct RayMatch {
    Eigen::Vector2d video, still;
};

/// Prior knowledge of T_still_video, before matching.
struct PosePrior {
    /// Moves points from the frame to the still, in the frame's orientation and in any unit of
    /// length.
    Eigen::Vector3d translation;
    /// Covariance of a small motion x of the video camera: T_still_video * exp(x).
    Matrix6 covariance;
};

struct PoseRefinement {
    bool accepted = false;
    RigidTransform motion;    ///< refined T_still_video = prior T_still_video * motion
    int patches = 0;          ///< number of matches
    int inliers = 0;          ///< number of matches that the solution explains
    double normalBefore = 0;  ///< median distance from the prior's lines [video px]
    double normalAfter = 0;   ///< the same for the final pose (refined, or the prior)
};

/// Refines the relative pose by robust Gauss-Newton over matched rays. Each match's inverse depth
/// is eliminated. The prior determines what the matches do not, above all the length of the
/// translation. Without a translation, the matches must agree with a pure rotation. `focal`: video
/// pixels per unit of ray.
///
/// The refinement is rejected if there are too few matches, if too many of them are outliers, or if
/// it reduces their distance from the epipolar lines by too little: the root of the difference of
/// the squared medians must exceed kExactEnough. Source: Hartley and Zisserman, 2nd ed., A6.3
/// (elimination); Beaton and Tukey 1974 (weights).
[[nodiscard]] PoseRefinement refineRelativePose(std::span<const RayMatch> matches,
                                                const PosePrior& prior, double focal);

/// A pose with at most this error [px] needs no refinement, because the errors of the matches would
/// move it as far.
inline constexpr double kExactEnough = 0.2;

/// Returns the covariance of a point's place in the still [rays^2] that results from the prior's
/// covariance.
[[nodiscard]] Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior);

}  // namespace mfar
