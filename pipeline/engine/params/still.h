#pragma once

#include <cstdint>

// Parameters of the preparation of a still, used by still_reduce.frag, still_raise.frag and the
// SIMD code of the same steps. gles_shaders/params_to_glsl.cmake translates this header for the
// shaders.
namespace mfar::params {

/// Weight of each neighbour in the filter that amplifies the finest detail of a still, because
/// linear look-ups lose some of this detail. Not used for a still that was reduced; see
/// still_raise.frag.
inline constexpr float kLinearLoss = 0.08F;

struct alignas(16) ReduceStill {
    std::int32_t alongX, alongY;  ///< direction of the filter: (1, 0) or (0, 1)
    float scale;                  ///< pixels of the picture per pixel of the result, at least 1
};

struct alignas(16) RaiseStill {
    float neighbours;  ///< weight of each neighbour: kLinearLoss or 0
};

}  // namespace mfar::params
