#pragma once

#include <cstdint>

namespace mfar::simd {

/// Number of spare entries that three kinds of arrays need at their end: the loaded part of a
/// layer's row, the arrays of LayerColumns, and the results of blendLayerRows() and
/// enlargeColours(). Vectors read the spare entries; in results, they also overwrite them.
inline constexpr int kLayerSpare = 64;

struct LayerColumns {
    /// Layer columns to the left and to the right of each output pixel, ascending.
    const std::int32_t *left, *right;
    const std::uint32_t* share;  ///< weight of the right column, see twiceInAWord()
    int origin, last;            ///< first and last layer column of the row's loaded part
};

/// A row of colours, interpolated between two rows of a layer. A word contains two channels [1/64
/// grey level].
struct BlendedColours {
    std::uint32_t *redBlue, *greenAlpha;
};

/// Returns a word whose lower and upper 16 bits both contain the weight `share` [2^-15]. `share`
/// must be in [0, 1].
[[nodiscard]] std::uint32_t twiceInAWord(float share);

/// Interpolates `count` RGBA8 colours between two rows. `share`: weight of the lower row, [0, 1].
void blendLayerRows(const std::uint32_t* above, const std::uint32_t* below, float share, int count,
                    const BlendedColours& out);
/// Interpolates a row between the layer's columns, and writes it as RGBA8.
void enlargeColours(const BlendedColours& part, const LayerColumns& columns, int count,
                    std::uint32_t* out);
/// Writes z of the layer for each output pixel, as virtual_layer.glsl does. The four layer pixels
/// around the output pixel are candidates if they have a depth. z is copied from the candidate that
/// is nearest in the picture; it is 0 without a candidate. `share`: weight of the row `below`.
void enlargeDepths(const float* above, const float* below, float share, const LayerColumns& columns,
                   int count, float* out);

/// Composites premultiplied RGBA8 colours, each times its visibility / 255, over a row of the
/// picture. The result is exact to within a grey level.
void blendRow(const std::uint32_t* colours, const std::uint8_t* visibility, int count,
              std::uint32_t* picture);

}  // namespace mfar::simd
