#pragma once

#include <algorithm>
#include <cmath>

namespace mfar::simd {

/// LensProjection in single precision: projects points [m] in front of the camera to pixels.
struct PointLens {
    /// fx to cy are in pixels; k1 to k3 are CameraModel::distortion.
    float fx = 1, fy = 1, cx = 0, cy = 0;
    float k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
    float rim = 1;          ///< radius of the outermost valid ray
    float rimRadial = 1;    ///< radial distortion factor at the rim
    float nearest = 0.01F;  ///< smallest z of a visible point [m]
};

/// A transformation [s R | t] of points: rotation R, translation t [m], and a scale s, which is 1
/// except for models (see pointTransformOf()).
struct PointTransform {
    float rows[3][4];
};

struct Point3 {
    float x = 0, y = 0, z = 0;
};

[[nodiscard]] inline Point3 transformed(const PointTransform& T, const Point3& p) {
    const auto row = [&](const float(&r)[4]) {
        return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
    };
    return {row(T.rows[0]), row(T.rows[1]), row(T.rows[2])};
}

/// Returns (w u, w v, w), as lens_projection.glsl does: (u, v) is the pixel, and w is the point's
/// z, which may be negative or 0.
[[nodiscard]] inline Point3 projected(const PointLens& lens, const Point3& p) {
    const float r = std::sqrt(p.x * p.x + p.y * p.y);
    const bool within = p.z * lens.rim > r;
    const float scale = within ? 1 / p.z : lens.rim / std::max(r, 1e-12F);
    const float x = p.x * scale, y = p.y * scale, q = x * x + y * y, xy = x * y;
    const float radial = 1 + q * (lens.k1 + q * (lens.k2 + q * lens.k3));
    const float u = x * radial + 2 * lens.p1 * xy + lens.p2 * (q + 2 * x * x);
    const float v = y * radial + lens.p1 * (q + 2 * y * y) + 2 * lens.p2 * xy;
    Point3 out{p.z * (lens.fx * u + lens.cx), p.z * (lens.fy * v + lens.cy), p.z};
    if (!within) {
        out.x += lens.rimRadial * lens.fx * (p.x - p.z * x);
        out.y += lens.rimRadial * lens.fy * (p.y - p.z * y);
    }
    return out;
}

}  // namespace mfar::simd
