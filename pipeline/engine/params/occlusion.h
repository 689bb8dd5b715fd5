#pragma once

#include <cstdint>

// Parameters that decide which pixels of virtual objects the real scene hides, in the shaders
// visibility_*.frag and in the SIMD code. params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

/// A sample of the real depth is valid if its inverse depth [1/m] is between kLeastInverseDepth and
/// kMostInverseDepth, and its standard deviation [1/m] is between kLeastDepthSigma and
/// kMostInverseDepth. kLeastDepthSigma excludes denormal numbers, because some GPUs flush them to
/// zero.
inline constexpr float kLeastInverseDepth = 1e-6F;
inline constexpr float kMostInverseDepth = 1e6F;
inline constexpr float kLeastDepthSigma = 1e-20F;
/// A virtual pixel is drawn only if kLeastVirtualDepth < z < kMostVirtualDepth [m].
inline constexpr float kLeastVirtualDepth = 1e-4F;
inline constexpr float kMostVirtualDepth = 1e6F;
/// Added to the colour weight of each depth sample. As a result, all colour weights are almost
/// equal if no sample has a similar colour, and only the samples' distances from the pixel matter.
inline constexpr float kLikenessFloor = 1e-3F;

struct alignas(16) Visibility {
    std::int32_t videoWidth, videoHeight;
    std::int32_t outputWidth, outputHeight;
    std::int32_t layerWidth, layerHeight;
    float scaleX, scaleY;            ///< video pixels per output pixel
    float layerScaleX, layerScaleY;  ///< layer pixels per output pixel
    float bias, softness;
    float virtualSigma;
    /// The colour weight of a depth sample is exp(-likeness * d^2) + kLikenessFloor. d is the
    /// distance between the colours of the sample and of the output pixel (channels in [0, 1]).
    float likeness;
};

}  // namespace mfar::params
