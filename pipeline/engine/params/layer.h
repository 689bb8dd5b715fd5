#pragma once

// Definitions shared by the code that draws the virtual layer and the code that uses it.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// The depth z of a virtual shadow on the real scene is reduced by this fraction of z. Otherwise
/// the real surface could hide the shadow, because both have the same depth. Flat real objects on
/// the surface are shadowed as well.
inline constexpr float kShadowLift = 0.02F;

}  // namespace mfar::params
