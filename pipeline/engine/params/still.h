#pragma once

#include <cstdint>

// Parameters for preparing a still in the shaders still_reduce.frag, still_quiet.frag and
// still_raise.frag and in SIMD. params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

/// Linear look-ups weaken a still's finest detail. A filter amplifies this detail beforehand: it
/// subtracts kLinearLoss times each of the four neighbours from a pixel, and adds 4 * kLinearLoss
/// times the pixel. A reduced still is not filtered; see still_raise.frag.
inline constexpr float kLinearLoss = 0.08F;

struct alignas(16) ReduceStill {
    std::int32_t alongX, alongY;  ///< direction of the filter: (1, 0) or (0, 1)
    float scale;                  ///< pixels of the picture per pixel of the result, >= 1
};

struct alignas(16) QuietStill {
    float noise;  ///< variance that is removed, > 0; grey levels are in [0, 1]
};

struct alignas(16) RaiseStill {
    float neighbours;  ///< kLinearLoss, or 0 for a reduced still
};

}  // namespace mfar::params
