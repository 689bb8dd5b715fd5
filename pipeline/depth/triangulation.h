#pragma once

#include "base/geometry.h"
#include "base/gl/buffer.h"
#include "base/gl/pass.h"
#include "base/gl/texture.h"

#include <cstdint>
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

/// Depth from a dense flow field between two views with lenses and poses of their own. In single
/// precision within 1e-6 of double precision down to 0.01 degrees of parallax, for rotations up to
/// 10 degrees; beyond, errors grow as plain single precision's do. Lives on the GL thread.
class Triangulation {
public:
    /// Allocates everything, and undistorts every pixel of both views.
    Triangulation(const CameraModel& a, const CameraModel& b);

    /// `flow`: x, y [px of b] for every pixel of a, 32-bit floats: a(p) looks like b(p + flow).
    /// Values that are not finite or lead out of b are no usable flow. `T_b_a` maps coordinates of
    /// a into b; without a finite one nothing is known. Throws std::invalid_argument for another
    /// size.
    void run(const gpu::Texture& flow, const RigidTransform& T_b_a,
             const TriangulationOptions& options);
    /// The same for a flow in memory, row-major, such as Pipeline::readFlow gives.
    void run(std::span<const float> flow, const RigidTransform& T_b_a,
             const TriangulationOptions& options);

    /// TriangulatedPoint of every pixel of view a, row-major.
    [[nodiscard]] const gpu::Buffer& points() const { return points_; }
    /// Waits for the GPU.
    [[nodiscard]] std::vector<TriangulatedPoint> read() const;

private:
    struct Params {  // triangulation.glsl
        std::int32_t sizes[4];
        float lensB[4], tangentialB[4];
        float turnHead[3][4], turnTail[3][4];
        float baselineHead[4], baselineTail[4];
        float tune[4];
    };

    [[nodiscard]] Params params(const RigidTransform& T_b_a,
                                const TriangulationOptions& options) const;
    [[nodiscard]] std::size_t pixels() const;

    CameraModel a_, b_;
    gpu::Texture raysA_, raysB_, flow_;
    gpu::Buffer points_;
    gpu::ComputePass<Params> fromFlow_, midpoint_;
};

}  // namespace mfar
