#pragma once

#include "pipeline/simd/paint_words.h"
#include "pipeline/simd/surface_rows.h"

#include <cstdint>

namespace mfar::simd {

// Colour of the surface at each pixel, independent of light: its texture over the pixel's
// footprint, averaged in linear light.

/// One size of a texture. Texel bytes are 255 times the square root of linear values; their squares
/// are blended, which is exact.
struct PaintLevel {
    std::uint32_t first;  ///< index of its first texel in PaintInput's array
    std::uint32_t size;   ///< width, height << 16
};

/// Paint of a triangle; one cache line, from which lanes gather words.
struct PaintTriangle {
    RasterPlane perZ, u, v;      ///< on the grid: 1 / z, u / z, v / z; set only for triangles that
                                 ///< are drawn
    std::uint32_t size = 0;      ///< of the texture's first level, as PaintLevel
    std::uint32_t levels = 0;    ///< index of the first level, and of the last relative to it << 24
    std::uint32_t material = 0;  ///< triangles of equal material are painted alike
    std::uint32_t unused[4] = {};
};
static_assert(sizeof(PaintTriangle) == 64);

struct PaintInput {
    const PaintWords* texels;
    const PaintLevel* levels;
    const PaintTriangle* triangles;
};

/// Pixels of a row of the layer, which has half the grid's resolution. Rows of the grid have
/// AlignedRows::kPadding to spare.
struct PaintRow {
    int x, y, count;                                   ///< pixels of the layer
    const std::uint32_t *upper, *lower;                ///< words of the first pixel's quarters
    const std::uint32_t *upperIndices, *lowerIndices;  ///< indices of triangles
    PaintWords* out;
};
/// Writes `count` pixels, and up to 7 beyond: sRGB bytes, 0 where no object is. If a pixel shows
/// several objects, the one with most quarters is painted (RestPixels), at the centre of those
/// quarters.
void paintRow(const PaintRow& row, const PaintInput& in);

}  // namespace mfar::simd
