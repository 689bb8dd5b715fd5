#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace mfar {

enum class TriangulationMethod {
    Flow,      ///< design.md, section 3: closed form in the flow along the epipolar line
    Midpoint,  ///< the paper's: midpoint of the shortest line between both rays
};

struct TriangulationOptions {
    TriangulationMethod method = TriangulationMethod::Flow;
    double flowSigma = 0.25;  ///< error of the flow along the line [px]
    /// Upper limit of the shortest line between both rays of an accepted point [m].
    double maxRayDistance = std::numeric_limits<double>::infinity();
};

/// Result of triangulating a pixel. No member is ever NaN or infinite.
struct TriangulatedPoint {
    /// 1/z in view a [1/m]; known if above 0. Zero: no parallax, behind a camera, at or beyond
    /// infinity, rays too far apart, or invalid flow.
    float inverseDepth = 0;
    /// Standard deviation due to the flow's error [1/m]. Grows without bound as the baseline across
    /// the ray vanishes, up to kUnknownSigma, which also marks an unknown depth.
    float sigma = 0;
    /// Flow component normal to the epipolar line [px of view b without its distortion, oriented as
    /// a]; positive clockwise from the direction of nearer points. If there is no line: the length
    /// of all flow that the rotation does not explain. Zero for invalid flow.
    float residual = 0;
    /// Shortest line between both rays, extended in both directions [m]. Zero for invalid flow.
    float rayDistance = 0;
};
inline constexpr float kUnknownSigma = 1e9F;  ///< [1/m]

/// A number in two parts: the head lies on a grid of 2^-12, so that products of two heads, and
/// their sums below 1, are exact in single precision; the tail is the rest.
struct SplitVector {
    Eigen::Vector2f head, tail;
};

/// Triangulates the flow of a measured method between two views, each with its own lens and pose.
/// In single precision, within 1e-6 of double precision down to 0.01 degrees of parallax for
/// rotations up to 10 degrees; beyond, errors grow as in plain single precision.
class Triangulation {
public:
    /// Allocates everything, and undistorts every pixel of both views.
    Triangulation(const CameraModel& a, const CameraModel& b);

    /// TriangulatedPoint of every pixel of view a, row-major. `flow`: x, y [px of b] for every
    /// pixel of a: a(p) looks like b(p + flow). Values that are not finite or lead outside b are
    /// invalid. `T_b_a` maps coordinates of a into b; if it is not finite, all depths are unknown.
    /// Throws std::invalid_argument for another size.
    const std::vector<TriangulatedPoint>& run(std::span<const float> flow,
                                              const RigidTransform& T_b_a,
                                              const TriangulationOptions& options);

private:
    CameraModel a_, b_;
    std::vector<SplitVector> raysA_, raysB_;  // normalised
    std::vector<TriangulatedPoint> points_;
};

}  // namespace mfar
