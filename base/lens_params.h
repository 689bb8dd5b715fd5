#pragma once

// gles_shaders/params_to_glsl.cmake translates this header to GLSL for the shaders.
namespace mfar::params {

/// A CameraModel without its picture size: fx, fy, cx, cy [px] and the distortion.
struct alignas(16) Lens {
    float fx, fy, cx, cy;
    float k1, k2, p1, p2, k3;
};

/// Number of fixed-point iterations that invert the lens's distortion. With the lenses in use, each
/// iteration adds at least one correct digit.
inline constexpr int kUndistortSteps = 12;

struct alignas(16) Row3 {
    float x, y, z;
};
struct alignas(16) Row4 {
    float x, y, z, w;
};

}  // namespace mfar::params
