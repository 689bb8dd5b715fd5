#pragma once

#include "pipeline/simd/paint_words.h"
#include "pipeline/simd/surface_rows.h"

#include <cstdint>

namespace mfar::simd {

// Paint is the colour of the surface at each pixel, without light: the surface's texture over the
// pixel's footprint, averaged in linear light.

/// One level of a texture. Bytes of texels are 255 times the square root of linear values; blending
/// their squares is exact.
struct PaintLevel {
    std::uint32_t first;  ///< index of its first texel in PaintInput's array
    std::uint32_t size;   ///< width in the low, height in the high 16 bits
};

/// Data for painting a triangle. It fills one cache line, from which lanes gather words.
struct PaintTriangle {
    RasterPlane perZ, u, v;      ///< 1 / z, u / z and v / z on the grid; set only for triangles
                                 ///< that are drawn
    std::uint32_t size = 0;      ///< of the texture's first level, see PaintLevel
    std::uint32_t levels = 0;    ///< index of first level; top byte: number of further levels
    std::uint32_t material = 0;  ///< triangles with equal numbers are painted in the same way
    std::uint32_t unused[4] = {};
};
static_assert(sizeof(PaintTriangle) == 64);

struct PaintInput {
    const PaintWords* texels;
    const PaintLevel* levels;
    const PaintTriangle* triangles;
};

/// Pixels of a row of the layer, which has half of the grid's resolution. Rows of the grid have
/// AlignedRows::kPadding to spare.
struct PaintRow {
    int x, y, count;                                   ///< pixels of the layer
    const std::uint32_t *upper, *lower;                ///< words of the first pixel's quarters
    const std::uint32_t *upperIndices, *lowerIndices;  ///< indices of triangles
    PaintWords* out;
};
/// Writes `count` pixels, and up to 7 beyond them: sRGB bytes, 0 where no object is. If a pixel
/// shows several objects, the one with most quarters is painted (as in RestPixels), at the centre
/// of these quarters.
void paintRow(const PaintRow& row, const PaintInput& in);

}  // namespace mfar::simd
