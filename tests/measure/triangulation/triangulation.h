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
    /// Longest line between both rays of a point that is accepted [m].
    double maxRayDistance = std::numeric_limits<double>::infinity();
};

/// What two views say about a pixel. No member is ever NaN or infinite.
struct TriangulatedPoint {
    /// 1/z in view a [1/m]; known when above 0. Zero: no parallax, behind a camera, at or beyond
    /// infinity, rays too far apart, or no usable flow.
    float inverseDepth = 0;
    /// Standard deviation that the flow's error causes [1/m]; grows without bound as the baseline
    /// across the ray vanishes, up to kUnknownSigma, which it also is where the depth is unknown.
    float sigma = 0;
    /// Flow normal to the epipolar line [px of view b without its distortion, oriented as a];
    /// positive clockwise from where nearer points lie. Where there is no line: the length of all
    /// flow that the rotation does not explain. Zero without usable flow.
    float residual = 0;
    /// Shortest line between both rays, unbounded both ways [m]. Zero without usable flow.
    float rayDistance = 0;
};
inline constexpr float kUnknownSigma = 1e9F;  ///< [1/m]

/// A number in two parts: the head on a grid of 2^-12, so that products of two heads, and their
/// sums below 1, are exact in single precision, and the rest.
struct SplitVector {
    Eigen::Vector2f head, tail;
};

/// Depth of a flow method that is measured, between two views with lenses and poses of their own.
/// In single precision within 1e-6 of double precision down to 0.01 degrees of parallax, for
/// rotations up to 10 degrees; beyond, errors grow as plain single precision's do.
class Triangulation {
public:
    /// Allocates everything, and undistorts every pixel of both views.
    Triangulation(const CameraModel& a, const CameraModel& b);

    /// TriangulatedPoint of every pixel of view a, row-major.
    /// `flow`: x, y [px of b] for every pixel of a: a(p) looks like b(p + flow). Values that are
    /// not finite or lead out of b are no usable flow. `T_b_a` maps coordinates of a into b;
    /// without a finite one nothing is known. Throws std::invalid_argument for another size.
    const std::vector<TriangulatedPoint>& run(std::span<const float> flow,
                                              const RigidTransform& T_b_a,
                                              const TriangulationOptions& options);

private:
    CameraModel a_, b_;
    std::vector<SplitVector> raysA_, raysB_;  // normalised
    std::vector<TriangulatedPoint> points_;
};

}  // namespace mfar
