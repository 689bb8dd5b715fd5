#pragma once

#include "base/lens_params.h"

#include <cstdint>

// Parameters of the luma pyramids in the shaders that make or read them and in the SIMD code.
// params_to_glsl.cmake translates this header to GLSL.
namespace mfar::params {

/// One level of a luma pyramid with 8 bits per pixel. A word contains four pixels, the leftmost in
/// the low byte.
struct alignas(16) LumaLevel {
    std::int32_t offset;  ///< start of the level in the pyramid's memory [words]
    std::int32_t pitch;   ///< words per row, including both margins
    std::int32_t width;
    std::int32_t height;
};
inline constexpr int kLumaMarginWords = 2;

inline constexpr float kLumaRed = 0.299F;
inline constexpr float kLumaGreen = 0.587F;
inline constexpr float kLumaBlue = 0.114F;

/// The video's finest pyramid level is smoothed with a three-tap filter along each axis. This is
/// the weight of each of the two neighbours. For the still, a larger area is averaged instead, see
/// LumaFromStill::footprint. Compared with no smoothing, 0.18 gains 0.3 dB on printed text and
/// costs 0.05 dB on photographs.
inline constexpr float kLumaSmoothing = 0.18F;

/// Each pixel of the still's finest pyramid level is the mean of this number of bilinear samples of
/// the still along each axis. The samples suffice for a LumaFromStill::footprint of up to 8 px.
inline constexpr int kFootprintTaps = 4;

/// A video pixel's ray (x, y, 1) is rotated into still camera coordinates. If the rotated z is
/// smaller than this, the ray points away from the still's picture.
inline constexpr float kLeastTurnedDepth = 0.05F;
/// Position in the still [px] of rays that point away from the still's picture.
inline constexpr float kFarOutside = -1e6F;

/// Both lenses, and the rotation R_still_video between the cameras. From them follows where the
/// still shows the infinitely distant point that is seen at a given video pixel.
struct alignas(16) Rig {
    Lens video, still;
    Row3 rotation[3];
};

struct alignas(16) LumaFromVideo {
    LumaLevel target;
    float smoothing;
};

struct alignas(16) LumaFromStill {
    Rig rig;
    LumaLevel target;
    float texelX, texelY;
    float footprint;  ///< size of a video pixel [still px] * lumaBoxWidening()
    float light;      ///< Guidance::light
};

struct alignas(16) LumaDown {
    LumaLevel fine, coarse;
};

}  // namespace mfar::params
