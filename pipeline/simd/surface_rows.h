#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "pipeline/simd/point_lens.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

// Rasterises surfaces into words of z and number, as warp_surface.glsl packs them: the upper 24
// bits of z [m], the number of what is seen. Lesser words are nearer; no order of drawing matters
// to them. Beside each word is kept which triangle it is of: of equal words the one drawn first.

inline constexpr std::uint32_t kNoSurface = 0xFFFFFFFF;
/// Behind all words without it: z has no sign.
inline constexpr std::uint32_t kBehindObjects = 0x80000000;

/// Corners of a mesh [m].
struct MeshRows {
    const float *x, *y, *z;
};
/// Corners on the surface's grid, whose pixel i reaches from i to i + 1; z [m] of any sign. x and y
/// are valid where z > 0.
struct CornerRows {
    float *x, *y, *z;
};
/// `count` corners through a lens, on a grid of twice the lens's pixels; rows have
/// kAlignment's bytes to spare.
void projectCorners(const MeshRows& mesh, int count, const PointTransform& view,
                    const PointLens& lens, const CornerRows& out);

/// A corner before the camera, on the grid.
struct RasterCorner {
    float x, y;
    float perZ;          ///< 1 / z
    float u = 0, v = 0;  ///< of a mask, over z
};

/// A value that is linear on the grid: at the centre of pixel (0, 0), steps.
struct RasterPlane {
    float first = 0, perX = 0, perY = 0;
};

/// A triangle made ready: its edges from upper to lower corners, so that both triangles of an edge
/// cross a row at the same place and no pixel between them is left out or drawn twice.
struct RasterTriangle {
    float top, middle, bottom;    ///< y of the corners
    float longX, upperX, lowerX;  ///< x at the upper end of each edge
    float longSlope, upperSlope, lowerSlope;
    int firstRow, lastRow;  ///< rows whose centres it covers, last excluded
    RasterPlane perZ;
    float leastPerZ, mostPerZ;
    std::uint32_t word;   ///< number, kBehindObjects
    std::uint32_t index;  ///< kept beside the word
    bool longIsLeft;
};

/// What a masked surface's texels say.
struct RasterMask {
    const std::uint8_t* rgba;  ///< four bytes a texel
    Size size;
    float cutoff;  ///< of alpha, [0, 1]: below it is a hole
};
struct MaskedTriangle {
    RasterTriangle triangle;
    RasterPlane u, v;  ///< over z
    RasterMask mask;
};

/// How a triangle is called in the words and beside them.
struct RasterName {
    std::uint32_t word, index;  ///< as RasterTriangle
};

/// False: it covers no row's centre, or has no area.
[[nodiscard]] bool makeTriangle(const RasterCorner (&corners)[3], const RasterName& name,
                                RasterTriangle& out);
/// The same with its mask.
[[nodiscard]] bool makeMasked(const RasterCorner (&corners)[3], const RasterName& name,
                              const RasterMask& mask, MaskedTriangle& out);

/// Twice the area between corners on the grid, with a sign: below 0 what faces away.
[[nodiscard]] float doubleArea(const RasterCorner (&corners)[3]);
/// Through values at three corners.
[[nodiscard]] RasterPlane planeThrough(const RasterCorner (&corners)[3], const float (&value)[3],
                                       float doubleArea);

/// Part of the grid that is drawn into: rows `where.y0` to `where.y1`, the same columns of each.
struct RasterBand {
    Rows<std::uint32_t> words;    ///< of the whole grid
    Rows<std::uint32_t> indices;  ///< the same; valid where there is a word
    PixelRect where;
};
void drawTriangles(std::span<const RasterTriangle> triangles, const RasterBand& band);
void drawMasked(std::span<const MaskedTriangle> triangles, const RasterBand& band);
/// kNoSurface in all of the band, and 0 in its place once all is drawn; kBehindObjects goes, too.
void clearBand(const RasterBand& band);
void finishBand(const RasterBand& band);

}  // namespace mfar::simd
