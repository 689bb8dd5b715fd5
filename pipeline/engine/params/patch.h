#pragma once

// Parameters of the comparison of 8x8 patches, used by patch.glsl and by the SIMD code of the same
// step. gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

inline constexpr float kPatchPixels = 64.0F;
/// Sum of the squared deviations from the mean that noise causes in a patch [grey levels^2]. A
/// patch with a smaller sum is flat.
inline constexpr float kPatchNoise = 128.0F;
/// Added to the diagonal of the Hessian. It limits the Gauss-Newton steps where there is no
/// gradient.
inline constexpr float kPatchDamping = 64.0F;
/// Squared length [px^2] of a Gauss-Newton step below which the refinement ends, and squared
/// distance [px^2] below which two candidate vectors count as equal.
inline constexpr float kShortestStep = 2.5e-5F;
inline constexpr float kSameCandidate = 0.25F;

}  // namespace mfar::params
