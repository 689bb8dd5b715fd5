#pragma once

#include <cstdint>

namespace mfar::simd {

/// Entries behind the last of a part of a layer's row that vectors may read.
inline constexpr int kLayerSpare = 64;

/// Where pixels of the output lie between the columns of a part of a layer's row.
struct LayerColumns {
    const std::int32_t *left, *right;  ///< columns of the layer around them, ascending
    const std::uint32_t* share;        ///< of the right column, 2^15 = 1, twice in 32 bits
    int origin, last;                  ///< columns in the part's first and last entry
};

/// Colours between two rows of a layer, two channels a word [1/64].
struct BlendedColours {
    std::uint32_t *redBlue, *greenAlpha;
};

/// A share of 16 bits, 2^15 = 1, twice in 32 bits. `share`: [0, 1].
[[nodiscard]] std::uint32_t twiceInAWord(float share);

/// Blends `count` RGBA8 colours of two rows; `share`: of the lower one, [0, 1].
void blendLayerRows(const std::uint32_t* above, const std::uint32_t* below, float share, int count,
                    const BlendedColours& out);
/// Colours between the columns, linear: `count` output pixels, RGBA8.
void enlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out);
/// z of the nearest of the four pixels that has one (virtual_layer.glsl); 0: none has. `below`: the
/// share of the lower row.
void enlargeDepths(const float* above, const float* below, float share, const LayerColumns& columns,
                   int count, float* out);

/// Puts premultiplied colours, each times its visibility / 255, over a row of the picture; all
/// RGBA8, within a grey level.
void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture);

}  // namespace mfar::simd
