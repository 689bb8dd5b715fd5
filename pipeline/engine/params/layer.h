#pragma once

// Definitions shared by the code that draws the virtual layer and the code that uses it.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// The depth z of a shadow on the real scene is reduced by this share of z. So the shadow remains
/// visible although its depth cannot be distinguished from that of the real surface, and flat
/// objects on the surface are shadowed as well.
inline constexpr float kShadowLift = 0.02F;

}  // namespace mfar::params
