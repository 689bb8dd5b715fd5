#pragma once

#include "pipeline/simd/paint_words.h"
#include "pipeline/simd/surface_rows.h"

#include <cstdint>

namespace mfar::simd {

// Which colour a surface has at each pixel, whatever light there is: its texture over the pixel's
// footprint, averaged in linear light.

/// One size of a texture. Bytes of its texels are 255 times the square root of linear values, which
/// blend exactly once they are squared.
struct PaintLevel {
    std::uint32_t first;  ///< texel among all
    std::uint32_t size;   ///< width, height << 16
};

/// What a triangle is painted with; a cache line, of which lanes gather words.
struct PaintTriangle {
    RasterPlane perZ, u, v;      ///< on the grid: 1 / z, uv over z; of those that are drawn alone
    std::uint32_t size = 0;      ///< of the texture's first level, as PaintLevel
    std::uint32_t levels = 0;    ///< first level, index of the last from there << 24
    std::uint32_t material = 0;  ///< equal ones are painted alike
    std::uint32_t unused[4] = {};
};
static_assert(sizeof(PaintTriangle) == 64);

struct PaintInput {
    const PaintWords* texels;
    const PaintLevel* levels;
    const PaintTriangle* triangles;
};

/// Pixels of a row of the layer, at half the grid's resolution. Rows of the grid have
/// AlignedRows::kPadding to spare.
struct PaintRow {
    int x, y, count;                                   ///< of the layer
    const std::uint32_t *upper, *lower;                ///< words of the first pixel's quarters
    const std::uint32_t *upperIndices, *lowerIndices;  ///< triangles
    PaintWords* out;
};
/// Writes `count` pixels, and up to 7 beyond: bytes of sRGB, 0 where no object is. Of several
/// objects in a pixel the one that has most of the quarters is painted (RestPixels), in the middle
/// of them.
void paintRow(const PaintRow& row, const PaintInput& in);

}  // namespace mfar::simd
