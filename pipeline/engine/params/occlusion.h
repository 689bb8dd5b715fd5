#pragma once

#include <cstdint>

// Parameters of deciding which pixels of virtual objects the real scene hides: visibility_*.frag
// and the SIMD code of the same steps. gles_shaders/params_to_glsl.cmake translates this header for
// the shaders.
namespace mfar::params {

/// A real sample is known if its inverse depth and its sigma are between these limits, exclusive
/// [1/m]. The limits exclude denormal sigmas, because some GPUs flush them to zero.
inline constexpr float kLeastInverseDepth = 1e-6F;
inline constexpr float kMostInverseDepth = 1e6F;
inline constexpr float kLeastDepthSigma = 1e-20F;
/// A virtual pixel is drawn if its z is between these limits, exclusive [m].
inline constexpr float kLeastVirtualDepth = 1e-4F;
inline constexpr float kMostVirtualDepth = 1e6F;
/// Added to the colour weight of each sample, so that distance decides where no colour is similar.
inline constexpr float kLikenessFloor = 1e-3F;

struct alignas(16) Visibility {
    std::int32_t videoWidth, videoHeight;    ///< [px]
    std::int32_t outputWidth, outputHeight;  ///< [px]
    std::int32_t layerWidth, layerHeight;    ///< of the virtual layer [px]
    float scaleX, scaleY;                    ///< video pixels per output pixel
    float layerScaleX, layerScaleY;          ///< layer pixels per output pixel
    float bias, softness;                    ///< CompositeOptions [sigmas]
    float virtualSigma;                      ///< [share of the depth]
    float likeness;                          ///< [1 / colour distance^2], colours in [0, 1]
};

}  // namespace mfar::params
