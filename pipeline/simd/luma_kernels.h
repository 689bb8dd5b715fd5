#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Three rows from which a smoothed row is computed. If the picture contains only luma, `red`
/// points to it, and `green` and `blue` are null.
struct SmoothRows {
    struct Planes {
        const std::uint8_t *red, *green, *blue;
    };
    Planes above, here, below;
};

/// Computes a row of the finest pyramid level with three taps along each axis, as
/// luma_from_video.comp does. `side`: weight of a neighbour. `width`: number of pixels of the row.
/// Nothing is read after the end of the input rows.
void smoothLumaRow(const SmoothRows& rows, int width, float side, std::uint8_t* to);

/// Computes a row of the next coarser pyramid level as means of 2x2 pixels. Reads 2 * width pixels
/// of both rows.
void halveLumaRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                  std::uint8_t* to);

/// Lenses of the video and the still camera, and the rotation between the cameras, as in rig.glsl.
struct StillLens {
    float videoPinhole[4], videoDistortion[5];  ///< fx fy cx cy; k1 k2 p1 p2 k3
    float stillPinhole[4], stillDistortion[5];
    float rotation[9];  ///< R_still_video, row by row

    bool operator==(const StillLens&) const = default;
};
/// Writes for each video pixel of row `y` its position in the still, without parallax [still px].
/// The position is params::kFarOutside if the pixel's ray points away from the still camera. Up to
/// 15 entries more than `width` are written.
void stillPixelRow(const StillLens& lens, int y, int width, float* stillX, float* stillY);

struct StillPicture {
    const std::uint8_t* pixels;
    std::ptrdiff_t pitch;
    int width, height;
};
/// The area of a video pixel in the still.
struct Footprint {
    float width;  ///< width of the square [still px]
    float light;  ///< Guidance::light
};
/// Writes for each video pixel of a row the mean of the still over the footprint around (stillX,
/// stillY). The mean has 4x4 bilinear taps, as in luma_from_still.comp.
void footprintRow(const StillPicture& still, const Footprint& footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to);

}  // namespace mfar::simd
