#pragma once

#include <cstdint>

// Preparation of a still: still_reduce.frag, still_raise.frag and their SIMD twins. Shaders
// read this header, too: gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Share of the neighbours in the filter that compensates the loss of the finest detail by linear
/// filtering, for a still that was not reduced; see still_raise.frag.
inline constexpr float kLinearLoss = 0.08F;

struct alignas(16) ReduceStill {
    std::int32_t alongX, alongY;  ///< 1, 0 or 0, 1
    float scale;                  ///< pixels of the picture per pixel of the result, at least 1
};

struct alignas(16) RaiseStill {
    float neighbours;  ///< kLinearLoss or 0
};

}  // namespace mfar::params
