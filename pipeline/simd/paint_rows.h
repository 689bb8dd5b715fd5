#pragma once

#include "base/paint_words.h"
#include "pipeline/simd/surface_rows.h"

#include <cstdint>

namespace mfar::simd {

// Paint is the colour of a pixel's surface without light: the surface's texture, averaged in linear
// light over the pixel's footprint.

/// Place of one level of a pyramid (see PaintPicture).
struct PaintLevel {
    std::uint32_t first;  ///< index of the level's first texel in PaintInput::texels
    std::uint32_t size;   ///< width [texels] in the low 16 bits, height in the high 16 bits
};

/// Data for painting a triangle. It fills one cache line, because vector lanes gather its words.
struct PaintTriangle {
    RasterPlane perZ, u, v;  ///< 1 / z, u / z and v / z on the grid; set if the triangle is drawn
    std::uint32_t size = 0;
    std::uint32_t levels = 0;    ///< index of the largest level; top byte: number of smaller levels
    std::uint32_t material = 0;  ///< triangles with equal numbers are painted in the same way
    std::uint32_t unused[4] = {};
};
static_assert(sizeof(PaintTriangle) == 64);

struct PaintInput {
    const PaintWords* texels;
    const PaintLevel* levels;
    const PaintTriangle* triangles;
};

/// `count` pixels of a row of the layer. Surfaces are rasterised on a grid with twice the layer's
/// resolution, so a pixel has four quarters. Rows of the grid need AlignedRows::kPadding bytes of
/// padding.
struct PaintRow {
    int x, y, count;
    /// Surfaces and triangles of the pixels' quarters, from `x` on.
    const std::uint32_t *upper, *lower;
    const std::uint32_t *upperIndices, *lowerIndices;
    PaintWords* out;
};
/// Writes the paint of `row.count` pixels as sRGB bytes, or 0 for a pixel without an object. Up to
/// 7 entries after the last pixel are overwritten. If the four quarters of a pixel show several
/// objects, the paint is that of the object with the most quarters (as in RestPixels), at the
/// centre of this object's quarters. If these show different materials, their mean is the paint.
void paintRow(const PaintRow& row, const PaintInput& in);

}  // namespace mfar::simd
