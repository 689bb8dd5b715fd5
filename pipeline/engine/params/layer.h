#pragma once

// The virtual layer: what its makers and its readers share. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// A shadow on the real scene is laid over that as if it were so much nearer [share of its z]: what
/// depth cannot tell from the surface that it lies on does not hide it, and what lies on that is in
/// the shadow as well.
inline constexpr float kShadowLift = 0.02F;

}  // namespace mfar::params
