#pragma once

// Parameters for comparing 8x8 patches in patch.glsl and in the SIMD code. params_to_glsl.cmake
// translates this header to GLSL.
namespace mfar::params {

inline constexpr float kPatchPixels = 64.0F;
/// Texture (see FlowCell) that noise alone can cause [grey levels^2]. It is added to the texture
/// when gain and cost are computed, so that noise has little effect on them in flat patches.
inline constexpr float kPatchNoise = 128.0F;
/// This value is added to the diagonal of the Hessian. It limits the length of Gauss-Newton steps
/// in patches without gradient.
inline constexpr float kPatchDamping = 64.0F;
/// The refinement ends without the next Gauss-Newton step if the squared length of this step is at
/// most kShortestStep [px^2]. Candidates whose squared distance is below kSameCandidate [px^2]
/// count as equal.
inline constexpr float kShortestStep = 2.5e-5F;
inline constexpr float kSameCandidate = 0.25F;

}  // namespace mfar::params
