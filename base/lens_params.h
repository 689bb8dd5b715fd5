#pragma once

// Shaders read this header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// CameraModel without its size: pinhole [px] and radial-tangential distortion.
struct alignas(16) Lens {
    float fx, fy, cx, cy;
    float k1, k2, p1, p2, k3;
};

/// Rows of matrices.
struct alignas(16) Row3 {
    float x, y, z;
};
struct alignas(16) Row4 {
    float x, y, z, w;
};

}  // namespace mfar::params
