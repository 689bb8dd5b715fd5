#pragma once

#include "base/se3.h"

#include <Eigen/Core>

#include <span>

namespace mfar {

/// A point of the scene as seen in frame and still: two rays (x / z, y / z). `video` is in video
/// camera coordinates. `still` is the ray from the still camera, rotated into the orientation of
/// the video camera by the prior pose.
struct RayMatch {
    Eigen::Vector2d video, still;
};

struct PosePrior {
    /// Adding this translation to a point's coordinates in the frame's camera gives those in the
    /// still camera, in the frame's orientation and in any unit of length.
    Eigen::Vector3d translation;
    /// Covariance of a small motion x of the video camera: T_still_video * exp(x).
    Matrix6 covariance;
};

struct PoseRefinement {
    bool accepted = false;
    RigidTransform motion;  ///< refined T_still_video = prior T_still_video * motion
    int patches = 0;
    int inliers = 0;
    /// Median distance of the matches from their epipolar lines [video px]: with the prior pose
    /// (normalBefore), and with the final pose (normalAfter). If the refinement was rejected, the
    /// final pose is the prior pose.
    double normalBefore = 0;
    double normalAfter = 0;
};

/// Refines the relative pose by robust Gauss-Newton steps over matched rays. The inverse depth of
/// each match is eliminated. Matches do not determine all unknowns, above all not the length of the
/// translation; the prior determines these. If the prior's translation is zero and its covariance
/// does not couple translation and rotation, the translation stays zero, and the matches must agree
/// with a pure rotation. `focal` is the focal length [video px].
///
/// The refinement is accepted under two conditions. `inliers` must be large enough, both by itself
/// and as a share of `patches`. The median distance from the epipolar lines must decrease clearly:
/// sqrt(normalBefore^2 - normalAfter^2) > kExactEnough, where normalAfter belongs to the refined
/// pose.
/// Source: Hartley and Zisserman, 2nd ed., A6.3 (elimination); Beaton and Tukey 1974 (weights).
[[nodiscard]] PoseRefinement refineRelativePose(std::span<const RayMatch> matches,
                                                const PosePrior& prior, double focal);

/// A refinement that removes an error of at most this [px] is rejected, because the errors of the
/// matches would add about as much.
inline constexpr double kExactEnough = 0.2;

/// Returns the covariance of a point's ray (x/z, y/z) in the still. It follows from the covariance
/// of the prior pose.
[[nodiscard]] Eigen::Matrix2d spreadOf(const RayMatch& match, const PosePrior& prior);

}  // namespace mfar
