#pragma once

#include "base/se3.h"

#include <Eigen/Core>

#include <span>

namespace mfar {

/// A point of the scene that the frame and the still show, as two rays (x / z, y / z). `video` is
/// in the video camera's coordinates. `still` starts at the still camera's centre, and is rotated
/// by the prior pose into the orientation of the video camera.
struct RayMatch {
    Eigen::Vector2d video, still;
};

/// What is known about T_still_video before matching.
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
    int inliers = 0;          ///< number of matches that the refined pose explains
    double normalBefore = 0;  ///< median distance of the matches from the epipolar lines of the
                              ///< prior pose [video px]
    double normalAfter = 0;   ///< median distance of the matches from the epipolar lines of the
                              ///< final pose [video px]; the final pose is the prior if the
                              ///< refinement was rejected
};

/// Refines the relative pose by robust Gauss-Newton steps over matched rays. The inverse depth of
/// each match is eliminated. What the matches do not determine, above all the length of the
/// translation, follows from the prior. Without a translation, the matches must agree with a pure
/// rotation. `focal`: video pixels per unit of ray.
///
/// The refinement is rejected if there are too few matches, if too many of them are outliers, or if
/// it hardly reduces their distance from the epipolar lines: the square root of (normalBefore^2 -
/// normalAfter^2) must exceed kExactEnough. Source: Hartley and Zisserman, 2nd ed., A6.3
/// (elimination); Beaton and Tukey 1974 (weights).
[[nodiscard]] PoseRefinement refineRelativePose(std::span<const RayMatch> matches,
                                                const PosePrior& prior, double focal);

/// A pose with at most this error [px] is not refined, because the errors of the matches would
/// change it by as much.
inline constexpr double kExactEnough = 0.2;

/// Returns the covariance of the position of a point in the still [rays^2] that results from the
/// prior's covariance.
[[nodiscard]] Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior);

}  // namespace mfar
