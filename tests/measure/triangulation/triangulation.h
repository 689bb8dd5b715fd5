#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace mfar {

enum class TriangulationMethod {
    Flow,      ///< closed form in the component of the flow along the epipolar line
    Midpoint,  ///< the paper's: midpoint of the shortest line between both rays
};

struct TriangulationOptions {
    TriangulationMethod method = TriangulationMethod::Flow;
    double flowSigma = 0.25;  ///< standard deviation of the flow along the line [px]
    /// A point is rejected if the shortest line between its two rays is longer [m].
    double maxRayDistance = std::numeric_limits<double>::infinity();
};

/// Result of triangulating one pixel. No member is ever NaN or infinite.
struct TriangulatedPoint {
    /// 1/z in view a [1/m]; unknown if 0. It is 0 if there is no parallax, if the point is behind a
    /// camera or at or beyond infinity, if the rays are too far apart, or if the flow is invalid.
    float inverseDepth = 0;
    /// Standard deviation due to the error of the flow [1/m]. It grows without bound as the
    /// component of the baseline across the ray vanishes. It is clamped to kUnknownSigma, which
    /// also marks an unknown depth.
    float sigma = 0;
    /// Flow component normal to the epipolar line [px of view b without its distortion, oriented as
    /// a]. Positive: clockwise from the direction in which nearer points move. If there is no
    /// epipolar line, the length of all flow that the rotation does not explain. Zero for invalid
    /// flow.
    float residual = 0;
    /// Length of the shortest line between both rays, which are extended in both directions [m].
    /// Zero for invalid flow.
    float rayDistance = 0;
};
inline constexpr float kUnknownSigma = 1e9F;  ///< [1/m]

/// A number in two parts, head and tail. Heads lie on a grid of 2^-12; so products of two heads,
/// and their sums below 1, are exact in single precision. The tail is the rest.
struct SplitVector {
    Eigen::Vector2f head, tail;
};

/// Triangulates the flow of a measured method between two views, each with its own lens and pose.
/// It computes in single precision. For rotations up to 10 degrees and at least 0.01 degrees of
/// parallax it agrees with double precision within 1e-6. Beyond these limits errors grow as in
/// plain single precision.
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
