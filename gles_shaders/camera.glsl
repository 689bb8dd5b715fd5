// The lens model of base/geometry.h: a pinhole camera with radial-tangential distortion. Rays are
// normalised (x/z, y/z). Pixel centres are at integers.

#include "base/lens_params.h"

vec2 distortRay(Lens c, vec2 p) {
    float r2 = dot(p, p);
    float radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
    float xy = p.x * p.y;
    return p * radial +
           vec2(2.0 * c.p1 * xy + c.p2 * (r2 + 2.0 * p.x * p.x),
                c.p1 * (r2 + 2.0 * p.y * p.y) + 2.0 * c.p2 * xy);
}

vec2 projectRay(Lens c, vec2 ray) {
    return vec2(c.fx, c.fy) * distortRay(c, ray) + vec2(c.cx, c.cy);
}

// Inverts the lens distortion by fixed-point iterations. Newton steps are not used: outside the
// lens's field of view, where the distorted radius decreases as the ray's radius grows, a step
// could end far from the solution.
vec2 unprojectPixel(Lens c, vec2 pixel) {
    vec2 target = (pixel - vec2(c.cx, c.cy)) / vec2(c.fx, c.fy);
    vec2 ray = target;
    for (int i = 0; i < kUndistortSteps; ++i) {
        ray += clamp(target - distortRay(c, ray), vec2(-0.5), vec2(0.5));
    }
    return ray;
}
