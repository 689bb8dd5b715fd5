#pragma once

#include <cstdint>

// Which virtual pixels the real scene hides: visibility_*.frag and their SIMD twins. Shaders read
// this header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Limits of the inverse depth and sigma of a known real sample, both excluded [1/m]. Some GPUs
/// flush denormal sigmas to zero.
inline constexpr float kLeastInverseDepth = 1e-6F;
inline constexpr float kMostInverseDepth = 1e6F;
inline constexpr float kLeastDepthSigma = 1e-20F;
/// Limits of the z of a drawn virtual pixel, both excluded [m].
inline constexpr float kLeastVirtualDepth = 1e-4F;
inline constexpr float kMostVirtualDepth = 1e6F;
/// Added to the likeness of each sample: where no colour is alike, distance decides.
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
