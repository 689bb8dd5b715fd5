#pragma once

#include "base/lens_params.h"

#include <cstdint>

// Parameters of synthetic_world.frag and synthetic_sensor.frag. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// Side of the tiles for which solids are listed [px].
inline constexpr int kSyntheticTile = 16;

/// One bit for each of 128 solids.
struct alignas(16) SolidMask {
    std::uint32_t first, second, third, fourth;
};

struct alignas(16) SyntheticWorld {
    Lens lens;
    SolidMask boxes;               ///< which solids are boxes
    float lightX, lightY, lightZ;  ///< unit vector towards the key light, camera frame
    float moverX, moverY, moverZ;  ///< centre of the moving object, camera frame [m]
    float moverRadius;             ///< [m]
    float red, green, blue;        ///< radiance of the background
    std::uint32_t tileColumns;
    std::uint32_t variationLayer;  ///< texture layer of the slow variation
};

struct alignas(16) SyntheticSensor {
    float redGain, greenGain, blueGain;
    float inverseGamma;  ///< 1 / gamma
    std::int32_t blurs;  ///< 1: 3x3 blur with weights for the centre, sides and corners
    float centreWeight, sideWeight, cornerWeight;
    /// 1: add noise of variance noisePerSignal x + noiseConstant.
    std::int32_t noisy;
    float noisePerSignal, noiseConstant;  ///< linear units
    std::uint32_t seed, channelSeed;
};

}  // namespace mfar::params
