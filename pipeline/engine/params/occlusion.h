#pragma once

#include <cstdint>

// Parameters that decide which pixels of virtual objects the real scene hides, used by
// visibility_*.frag and by the SIMD code of the same steps. gles_shaders/params_to_glsl.cmake
// translates this header for the shaders.
namespace mfar::params {

/// A sample of the real depth is valid if its inverse depth [1/m] is between kLeastInverseDepth and
/// kMostInverseDepth, and its sigma [1/m] between kLeastDepthSigma and kMostInverseDepth. The limit
/// kLeastDepthSigma excludes denormal numbers, because some GPUs flush them to zero.
inline constexpr float kLeastInverseDepth = 1e-6F;
inline constexpr float kMostInverseDepth = 1e6F;
inline constexpr float kLeastDepthSigma = 1e-20F;
/// A virtual pixel is drawn if its z is between these limits, exclusive [m].
inline constexpr float kLeastVirtualDepth = 1e-4F;
inline constexpr float kMostVirtualDepth = 1e6F;
/// Added to the weight that a sample gets by its colour, so that the distance determines the weight
/// where no colour is similar.
inline constexpr float kLikenessFloor = 1e-3F;

struct alignas(16) Visibility {
    std::int32_t videoWidth, videoHeight;    ///< [px]
    std::int32_t outputWidth, outputHeight;  ///< [px]
    std::int32_t layerWidth, layerHeight;    ///< size of the virtual layer [px]
    float scaleX, scaleY;                    ///< video pixels per output pixel
    float layerScaleX, layerScaleY;          ///< layer pixels per output pixel
    float bias, softness;                    ///< as in CompositeOptions [sigmas]
    float virtualSigma;                      ///< CompositeOptions::virtualSigma
    float likeness;                          ///< factor of the squared colour distance in the
                                             ///< exponent of the weight; colours are in [0, 1]
};

}  // namespace mfar::params
