#pragma once

#include <cstdint>

// Which virtual pixels the real scene hides: visibility_*.frag and their SIMD twins. Shaders read
// this header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Inverse depth and sigma of a real sample that is known, both ends excluded [1/m]. Denormal
/// sigmas are zero to some GPUs.
inline constexpr float kLeastInverseDepth = 1e-6F;
inline constexpr float kMostInverseDepth = 1e6F;
inline constexpr float kLeastDepthSigma = 1e-20F;
/// z of a virtual pixel that is drawn, both ends excluded [m].
inline constexpr float kLeastVirtualDepth = 1e-4F;
inline constexpr float kMostVirtualDepth = 1e6F;
/// Likeness that is added to each sample's: where nothing is alike, distance decides.
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
