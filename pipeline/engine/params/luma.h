#pragma once

#include "base/lens_params.h"

#include <cstdint>

// Parameters of the luma pyramids, used by luma_from_video.comp, luma_from_still.comp,
// luma_down.comp, the SIMD code of the same steps, and all programs that read the pyramids.
// gles_shaders/params_to_glsl.cmake translates this header for the shaders.
namespace mfar::params {

/// One level of a luma pyramid: 8 bits per pixel, four pixels per word, the leftmost pixel in the
/// low byte.
struct alignas(16) LumaLevel {
    std::int32_t offset;  ///< start of the level in the pyramid's memory [words]
    std::int32_t pitch;   ///< words per row, including kLumaMarginWords of replicated border on
                          ///< each side
    std::int32_t width;   ///< [px]
    std::int32_t height;  ///< [px]
};
inline constexpr int kLumaMarginWords = 2;

/// Luma weights of Rec. 601.
inline constexpr float kLumaRed = 0.299F;
inline constexpr float kLumaGreen = 0.587F;
inline constexpr float kLumaBlue = 0.114F;

/// Weight of each neighbour in the smoothing of the finest pyramid level. Compared with no
/// smoothing, a weight of 0.18 gains 0.3 dB on printed text and costs 0.05 dB on photographs.
inline constexpr float kLumaSmoothing = 0.18F;

/// Number of bilinear samples of the still along each axis of a video pixel. They cover a footprint
/// of up to 8 still px.
inline constexpr int kFootprintTaps = 4;

/// A ray of depth 1 is rotated into the coordinates of the still camera. If its depth there is less
/// than this, the ray points away from what the still shows.
inline constexpr float kLeastTurnedDepth = 0.05F;
/// Coordinates [px] that stand for the position in the still of a ray that points away: far
/// outside.
inline constexpr float kFarOutside = -1e6F;
/// Number of fixed-point iterations that invert the lens's distortion. With the lenses in use, each
/// iteration adds at least one correct digit.
inline constexpr int kUndistortSteps = 12;

/// Both lenses and the rotation between the cameras. They determine where the still shows a video
/// pixel that is infinitely far away.
struct alignas(16) Rig {
    Lens video, still;
    Row3 rotation[3];  ///< R_still_video
};

struct alignas(16) LumaFromVideo {
    LumaLevel target;
    float smoothing;  ///< weight of each neighbour
};

struct alignas(16) LumaFromStill {
    Rig rig;
    LumaLevel target;
    float texelX, texelY;  ///< 1 / size of the still [1/px]
    float footprint;       ///< size of a video pixel [still px]
};

struct alignas(16) LumaDown {
    LumaLevel fine, coarse;
};

}  // namespace mfar::params
