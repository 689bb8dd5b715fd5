#pragma once

#include "base/se3.h"

#include <Eigen/Core>

#include <span>

namespace mfar {

/// A point of the scene as the frame and the still show it: rays (x / z, y / z), `video` in the
/// video camera's coordinates, `still` from the still camera's centre in the orientation that the
/// prior gives the video camera.
struct RayMatch {
    Eigen::Vector2d video, still;
};

/// What is known of T_still_video before the pictures are looked at.
struct PosePrior {
    /// Of points from the frame to the still, in the frame's orientation; its unit of length is
    /// free.
    Eigen::Vector3d translation;
    /// Of a small motion x in the video camera's own frame, T_still_video * exp(x).
    Matrix6 covariance;
};

struct PoseRefinement {
    bool accepted = false;
    RigidTransform motion;    ///< refined T_still_video = prior T_still_video * motion
    int patches = 0;          ///< matches that were there
    int inliers = 0;          ///< of them, what the solution explains
    double normalBefore = 0;  ///< median distance from the prior's epipolar lines [video px]
    double normalAfter = 0;   ///< the same of the pose to use: refined if accepted, else the prior
};

/// The relative pose by robust Gauss-Newton over matched rays, each match's inverse depth
/// eliminated. The prior holds what the matches do not fix, the length of the translation first of
/// all. Without a translation the matches must agree with a rotation alone. `focal`: video pixels a
/// unit of ray.
///
/// Not accepted when the matches are too few, too many of them disagree, or the prior's share in
/// their distance from the epipolar lines is below kExactEnough.
/// Source: Hartley and Zisserman, 2nd ed., A6.3 (elimination); Beaton and Tukey 1974 (weights).
[[nodiscard]] PoseRefinement refineRelativePose(std::span<const RayMatch> matches,
                                                const PosePrior& prior, double focal);

/// A pose this good needs no refinement: the matches' own errors would move it as much [px].
inline constexpr double kExactEnough = 0.2;

/// Covariance of where the still shows a point [rays^2] from that of the prior.
[[nodiscard]] Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior);

}  // namespace mfar
