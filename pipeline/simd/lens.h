#pragma once

namespace mfar::simd {

/// Maps rays (x / z, y / z) to pixels: a pinhole camera with radial and tangential distortion.
struct Lens {
    /// fx to cy are in pixels; k1 to k3 are CameraModel::distortion.
    float fx = 1, fy = 1, cx = 0, cy = 0;
    float k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
    /// Squared radius of the outermost valid rays. Rays farther out are moved inwards to this
    /// radius.
    float rim2 = 1;
};

}  // namespace mfar::simd
