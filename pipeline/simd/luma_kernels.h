#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Rows that a smoothed row is made of. RGB: three planes; luma: the first alone, the others null.
struct SmoothRows {
    struct Planes {
        const std::uint8_t *red, *green, *blue;
    };
    Planes above, here, below;
};

/// A row of the finest level as luma_from_video.comp makes it: 3x3 pixels, `side` is the weight of
/// each side's neighbour. Writes `width` pixels and reads no others.
void smoothLumaRow(const SmoothRows& rows, int width, float side, std::uint8_t* to);

/// A row of the next coarser level: means of 2x2 pixels. Reads 2 * width pixels of both rows.
void halveLumaRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                  std::uint8_t* to);

/// Both lenses and the rotation between them, as rig.glsl has them.
struct StillLens {
    float videoPinhole[4], videoDistortion[5];  ///< fx fy cx cy; k1 k2 p1 p2 k3
    float stillPinhole[4], stillDistortion[5];
    float rotation[9];  ///< R_still_video, row by row

    bool operator==(const StillLens&) const = default;
};
/// Still pixels of the video pixels of a row, far outside where the ray points away. Writes up to
/// 15 elements more than `width`.
void stillPixelRow(const StillLens& lens, int y, int width, float* stillX, float* stillY);

struct StillPicture {
    const std::uint8_t* pixels;
    std::ptrdiff_t pitch;  ///< bytes
    int width, height;     ///< [px]
};
/// Mean of the still over the footprint [still px] of each video pixel of a row: 4x4 bilinear taps,
/// as luma_from_still.comp takes them.
void footprintRow(const StillPicture& still, float footprint, const float* stillX,
                  const float* stillY, int width, std::uint8_t* to);

}  // namespace mfar::simd
