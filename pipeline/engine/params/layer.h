#pragma once

// params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

/// The depth z of a virtual shadow on the real scene is reduced by this fraction. Otherwise the
/// real surface at the same depth could hide the shadow. The shadow therefore also falls on flat
/// real objects that lie on the surface.
inline constexpr float kShadowLift = 0.02F;

}  // namespace mfar::params
