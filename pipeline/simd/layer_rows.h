#pragma once

#include <cstdint>

namespace mfar::simd {

/// Number of entries after a part of a layer's row that vectors may read.
inline constexpr int kLayerSpare = 64;

/// Positions of output pixels between the columns of a part of a layer's row.
struct LayerColumns {
    const std::int32_t *left, *right;  ///< the layer's columns on either side of a pixel, ascending
    const std::uint32_t* share;        ///< weight of the right column, as twiceInAWord()
    int origin, last;                  ///< columns of the first and last entry of the part
};

/// Colours interpolated between two rows of a layer: two channels per word [1/64 grey level].
struct BlendedColours {
    std::uint32_t *redBlue, *greenAlpha;
};

/// Returns the weight `share`, which is in [0, 1], in units of 2^-15 in 16 bits, and stores it
/// twice in the 32-bit word.
[[nodiscard]] std::uint32_t twiceInAWord(float share);

/// Interpolates `count` RGBA8 colours between two rows. `share`: weight of the lower row, [0, 1].
void blendLayerRows(const std::uint32_t* above, const std::uint32_t* below, float share, int count,
                    const BlendedColours& out);
/// Interpolates linearly between the layer's columns. Writes `count` output pixels in RGBA8.
void enlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out);
/// For each output pixel, returns z of the nearest of the four surrounding layer pixels that has a
/// depth (virtual_layer.glsl); 0: none of them has one. `share`: weight of the row `below`.
void enlargeDepths(const float* above, const float* below, float share, const LayerColumns& columns,
                   int count, float* out);

/// Composites premultiplied colours, each times its visibility / 255, over a row of the picture.
/// All are RGBA8. The result is exact to within a grey level.
void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture);

}  // namespace mfar::simd
