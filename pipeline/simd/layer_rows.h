#pragma once

#include <cstdint>

namespace mfar::simd {

/// Number of readable entries that must follow a part of a layer's row, because vectors read them.
inline constexpr int kLayerSpare = 64;

struct LayerColumns {
    const std::int32_t *left, *right;  ///< the layer's columns on either side of each output pixel,
                                       ///< ascending
    const std::uint32_t* share;        ///< weight of the right column, see twiceInAWord()
    int origin, last;                  ///< columns of the first and last entry of the row's loaded
                                       ///< part
};

/// Colours interpolated between two rows of a layer: two channels per word [1/64 grey level].
struct BlendedColours {
    std::uint32_t *redBlue, *greenAlpha;
};

/// Returns the weight `share`, in [0, 1], as 16 bits in units of 2^-15, twice in the 32-bit word.
[[nodiscard]] std::uint32_t twiceInAWord(float share);

/// Interpolates `count` RGBA8 colours between two rows. `share`: weight of the lower row, [0, 1].
void blendLayerRows(const std::uint32_t* above, const std::uint32_t* below, float share, int count,
                    const BlendedColours& out);
void enlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out);
/// Copies, for each output pixel, the z of one of the four surrounding layer pixels: of those that
/// have a depth, the one closest to the output pixel (virtual_layer.glsl). Writes 0 if none has.
/// `share`: weight of the row `below`.
void enlargeDepths(const float* above, const float* below, float share, const LayerColumns& columns,
                   int count, float* out);

/// Composites premultiplied RGBA8 colours, each times its visibility / 255, over a row of the
/// picture. The result is exact to within a grey level.
void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture);

}  // namespace mfar::simd
