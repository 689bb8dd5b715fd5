#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Input rows of a smoothed row. RGB: three planes; luma: only the first, the others null.
struct SmoothRows {
    struct Planes {
        const std::uint8_t *red, *green, *blue;
    };
    Planes above, here, below;
};

/// A row of the finest level, as in luma_from_video.comp: 3x3 taps; `side`: weight of each
/// neighbour. Writes `width` pixels and reads no pixels beyond.
void smoothLumaRow(const SmoothRows& rows, int width, float side, std::uint8_t* to);

/// A row of the next coarser level: means of 2x2 pixels. Reads 2 * width pixels of both rows.
void halveLumaRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                  std::uint8_t* to);

/// Both lenses and the rotation between them, as in rig.glsl.
struct StillLens {
    float videoPinhole[4], videoDistortion[5];  ///< fx fy cx cy; k1 k2 p1 p2 k3
    float stillPinhole[4], stillDistortion[5];
    float rotation[9];  ///< R_still_video, row by row

    bool operator==(const StillLens&) const = default;
};
/// Positions in the still of a row's video pixels [still px]; far outside if the ray points away.
/// Writes up to 15 elements more than `width`.
void stillPixelRow(const StillLens& lens, int y, int width, float* stillX, float* stillY);

struct StillPicture {
    const std::uint8_t* pixels;
    std::ptrdiff_t pitch;  ///< bytes
    int width, height;     ///< [px]
};
/// Mean of the still over the footprint [still px] of each video pixel of a row: 4x4 bilinear taps,
/// as in luma_from_still.comp.
void footprintRow(const StillPicture& still, float footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to);

}  // namespace mfar::simd
