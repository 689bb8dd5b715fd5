#pragma once

// Definitions shared by the producers and users of the virtual layer. Shaders read this header,
// too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Depth of a shadow on the real scene is reduced by this share of its z. So real depth that cannot
/// be distinguished from the shadowed surface does not hide the shadow, and flat objects on the
/// surface are shadowed as well.
inline constexpr float kShadowLift = 0.02F;

}  // namespace mfar::params
