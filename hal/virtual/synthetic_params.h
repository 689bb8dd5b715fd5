#pragma once

#include "base/lens_params.h"

#include <cstdint>

// Parameters of synthetic_world.frag and synthetic_sensor.frag. gles_shaders/params_to_glsl.cmake
// translates this header to GLSL.
namespace mfar::params {

/// Side of a tile [px]. The renderer lists for each tile the solids that may be visible in it.
inline constexpr int kSyntheticTile = 16;

struct alignas(16) SolidMask {
    std::uint32_t first, second, third, fourth;
};

struct alignas(16) SyntheticWorld {
    Lens lens;
    SolidMask boxes;
    float lightX, lightY, lightZ;  ///< unit vector towards the key light, in the camera's frame
    float moverX, moverY, moverZ;  ///< centre of the moving object, in the camera's frame [m]
    float moverRadius;             ///< [m]; 0: there is no moving object
    float red, green, blue;
    std::uint32_t tileColumns;
    std::uint32_t variationLayer;  ///< index of the texture with the low-frequency variation
};

struct alignas(16) SyntheticSensor {
    float redGain, greenGain, blueGain;
    float inverseGamma;
    std::int32_t blurs;
    float centreWeight, sideWeight, cornerWeight;
    /// 1: add noise with the variance noisePerSignal * x + noiseConstant to each linear value x.
    std::int32_t noisy;
    float noisePerSignal, noiseConstant;
    std::uint32_t seed, channelSeed;
};

}  // namespace mfar::params
