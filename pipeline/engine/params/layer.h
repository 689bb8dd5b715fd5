#pragma once

// params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

/// A virtual shadow on a real surface has the depth of this surface. The shadow's depth z is
/// reduced by this fraction, so that the surface does not hide the shadow. Flat real objects on the
/// surface therefore do not hide it either.
inline constexpr float kShadowLift = 0.02F;

}  // namespace mfar::params
