#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// The rows that a smoothed row is computed from: three planes for RGB; for luma only the first
/// plane, the other two are null.
struct SmoothRows {
    struct Planes {
        const std::uint8_t *red, *green, *blue;
    };
    Planes above, here, below;
};

/// Computes a row of the finest pyramid level with 3x3 taps, as luma_from_video.comp. `side`:
/// weight of each neighbour. Writes `width` pixels and reads no pixels beyond them.
void smoothLumaRow(const SmoothRows& rows, int width, float side, std::uint8_t* to);

/// Computes a row of the next coarser pyramid level as means of 2x2 pixels. Reads 2 * width pixels
/// of both rows.
void halveLumaRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                  std::uint8_t* to);

/// The lenses of video and still camera and the rotation between these cameras, as in rig.glsl.
struct StillLens {
    float videoPinhole[4], videoDistortion[5];  ///< fx fy cx cy; k1 k2 p1 p2 k3
    float stillPinhole[4], stillDistortion[5];
    float rotation[9];  ///< R_still_video, row by row

    bool operator==(const StillLens&) const = default;
};
/// Positions of a row's video pixels in the still [still px]; far outside if a pixel's ray points
/// away from the still's view. Writes up to 15 entries more than `width`.
void stillPixelRow(const StillLens& lens, int y, int width, float* stillX, float* stillY);

struct StillPicture {
    const std::uint8_t* pixels;
    std::ptrdiff_t pitch;  ///< bytes from one row to the next
    int width, height;     ///< [px]
};
/// Mean of the still over the footprint [still px] of each video pixel of a row: 4x4 bilinear taps,
/// as in luma_from_still.comp.
void footprintRow(const StillPicture& still, float footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to);

}  // namespace mfar::simd
