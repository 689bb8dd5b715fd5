#pragma once

#include "base/lens_params.h"

#include <cstdint>

// Luma pyramids: luma_from_video.comp, luma_from_still.comp, luma_down.comp, their SIMD twins, and
// all programs that read the pyramids. Shaders read this header, too:
// gles_shaders/params_to_glsl.cmake.
namespace mfar::params {

/// One level of a luma pyramid: 8 bits per pixel, four pixels per word, the leftmost in the low
/// byte.
struct alignas(16) LumaLevel {
    std::int32_t offset;  ///< of the level in the pyramid's memory [words]
    std::int32_t pitch;   ///< [words], with kLumaMarginWords of replicated border on each side
    std::int32_t width;   ///< [px]
    std::int32_t height;  ///< [px]
};
inline constexpr int kLumaMarginWords = 2;

/// Luma weights of Rec. 601.
inline constexpr float kLumaRed = 0.299F;
inline constexpr float kLumaGreen = 0.587F;
inline constexpr float kLumaBlue = 0.114F;

/// Weight of each neighbour in the smoothing of the finest level. Compared with no smoothing, 0.18
/// gains 0.3 dB on printed text and costs 0.05 dB on photographs.
inline constexpr float kLumaSmoothing = 0.18F;

/// Bilinear samples of the still per video pixel and axis: they cover a footprint of up to 8 px.
inline constexpr int kFootprintTaps = 4;

/// Lower limit of the depth that a ray of unit depth keeps when it is rotated into the still
/// camera; rays below it point away.
inline constexpr float kLeastTurnedDepth = 0.05F;
/// Both still pixel coordinates of a ray that points away: far outside.
inline constexpr float kFarOutside = -1e6F;
/// Fixed-point iterations that invert a lens's distortion: for the lenses in use each gains a digit
/// or more.
inline constexpr int kUndistortSteps = 12;

/// Where the still shows a video pixel at infinity: both lenses and the rotation between them.
struct alignas(16) Rig {
    Lens video, still;
    Row3 rotation[3];  ///< R_still_video
};

struct alignas(16) LumaFromVideo {
    LumaLevel target;
    float smoothing;  ///< weight of the neighbour on each side
};

struct alignas(16) LumaFromStill {
    Rig rig;
    LumaLevel target;
    float texelX, texelY;  ///< 1 / size of the still [1/px]
    float footprint;       ///< of a video pixel [still px]
};

struct alignas(16) LumaDown {
    LumaLevel fine, coarse;
};

}  // namespace mfar::params
