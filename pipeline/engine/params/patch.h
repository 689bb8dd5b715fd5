#pragma once

// Comparison of 8x8 patches: patch.glsl and its SIMD twins. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

inline constexpr float kPatchPixels = 64.0F;
/// Noise energy of a patch [grey levels^2]: a patch with less energy is flat.
inline constexpr float kPatchNoise = 128.0F;
/// Added to the diagonal of the Hessian: limits steps where there is no gradient.
inline constexpr float kPatchDamping = 64.0F;
/// Squared length [px^2] below which a step ends the search, and below which two candidates are
/// equal.
inline constexpr float kShortestStep = 2.5e-5F;
inline constexpr float kSameCandidate = 0.25F;

}  // namespace mfar::params
