#pragma once

#include <cstdint>

namespace mfar::simd {

/// Two rows of a virtual layer that has a size of its own, and where an output row lies between.
struct LayerRows {
    const std::uint32_t *colourAbove, *colourBelow;  ///< RGBA8, premultiplied
    const float *depthAbove, *depthBelow;            ///< z [m]
    float share;                                     ///< of the lower row, [0, 1)
};
/// For pixels of the output: the layer's columns around them.
struct LayerColumns {
    const std::int32_t *left, *right;
    const float* share;  ///< of the right column, [0, 1)
};

/// Colours between four pixels of the layer, linear. Writes `count` pixels.
void enlargeColours(const LayerRows& rows, const LayerColumns& columns, int count,
                    std::uint32_t* out);
/// z of the nearest of the four pixels that has one (virtual_layer.glsl); 0: none has.
void enlargeDepths(const LayerRows& rows, const LayerColumns& columns, int count, float* out);

/// Puts premultiplied colours, each times its visibility / 255, over a row of the picture; all
/// RGBA8, within a grey level.
void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture);

}  // namespace mfar::simd
