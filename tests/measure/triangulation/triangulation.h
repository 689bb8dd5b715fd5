#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace mfar {

enum class TriangulationMethod {
    Flow,      ///< closed form from the flow along the epipolar line
    Midpoint,  ///< the paper's method: midpoint of the shortest line between both rays
};

struct TriangulationOptions {
    TriangulationMethod method = TriangulationMethod::Flow;
    double flowSigma = 0.25;  ///< standard deviation of the flow along the line [px]
    /// If the two rays of a point are farther apart than this distance, its depth is unknown [m].
    double maxRayDistance = std::numeric_limits<double>::infinity();
};

/// Result for one pixel. No member is ever NaN or infinite.
struct TriangulatedPoint {
    /// 1/z in view a [1/m]; 0: unknown. Unknown if there is no parallax, if the point is behind a
    /// camera or at infinity, if the rays are too far apart, or if the flow is invalid.
    float inverseDepth = 0;
    /// Standard deviation due to the error of the flow [1/m]. As the component of the baseline
    /// across the ray vanishes, it grows up to kUnknownSigma. This is also its value for an unknown
    /// depth.
    float sigma = 0;
    /// Flow normal to the epipolar line [px of an undistorted view b that is oriented as view a].
    /// Positive: clockwise from the direction in which nearer points move. Without an epipolar
    /// line: length of all flow that remains after the rotation is removed. Zero for invalid flow.
    float residual = 0;
    /// Length of the shortest line between both rays, extended in both directions [m]. Zero for
    /// invalid flow.
    float rayDistance = 0;
};
inline constexpr float kUnknownSigma = 1e9F;  ///< [1/m]

/// A vector in two parts. Heads lie on a grid of 2^-12, so products of two heads, and their sums
/// below 1, are exact in single precision. The tail is the rest.
struct SplitVector {
    Eigen::Vector2f head, tail;
};

/// Triangulates the flow between two views, each with its own lens and pose, in single precision.
/// Its depths differ from double precision by less than 1e-6 of their value for rotations up to 10
/// degrees and at least 0.01 degrees of parallax. Beyond these limits, errors grow as in plain
/// single precision.
class Triangulation {
public:
    /// Allocates all memory, and undistorts every pixel of both views.
    Triangulation(const CameraModel& a, const CameraModel& b);

    /// Returns the TriangulatedPoint of every pixel of view a, row by row. `flow`: x, y [px of b]
    /// for every pixel p of a, where a(p) looks like b(p + flow). A flow that is not finite or
    /// leads outside b is invalid. `T_b_a` maps coordinates of a into b; if it is not finite, all
    /// depths are unknown. Throws std::invalid_argument if `flow` has another size.
    const std::vector<TriangulatedPoint>& run(std::span<const float> flow,
                                              const RigidTransform& T_b_a,
                                              const TriangulationOptions& options);

private:
    CameraModel a_, b_;
    std::vector<SplitVector> raysA_, raysB_;  // normalised coordinates
    std::vector<TriangulatedPoint> points_;
};

}  // namespace mfar
