#pragma once

#include <cstdint>

// Preparation of a still: still_reduce.frag, still_low.frag, still_detail.frag and their SIMD
// twins. Shaders read this header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Width of what a video pixel sees, in its pitch: the optics make it a quarter wider (+0.07 dB on
/// photographs, +0.4 dB on synthetic scenes against the bare pitch).
inline constexpr float kFootprint = 1.25F;

/// Neighbours' share that makes up for what a linear filter takes from the finest detail of a still
/// that was not reduced; see still_detail.frag.
inline constexpr float kLinearLoss = 0.08F;

struct alignas(16) ReduceStill {
    std::int32_t alongX, alongY;  ///< 1, 0 or 0, 1
    float scale;                  ///< pixels of the picture per pixel of the result, at least 1
};

struct alignas(16) StillLow {
    float texelX, texelY;  ///< 1 / size of the low picture [1/px]
    float tapX, tapY;      ///< between the 4x4 samples of a pixel [shares of the picture]
};

struct alignas(16) StillDetail {
    std::int32_t lowWidth, lowHeight;  ///< [px]
    float scaleX, scaleY;              ///< low pixels per still pixel
    float neighbours;                  ///< kLinearLoss or 0
};

}  // namespace mfar::params
