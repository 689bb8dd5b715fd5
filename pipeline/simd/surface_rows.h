#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "pipeline/simd/point_lens.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar::simd {

// These functions rasterise surfaces. A pixel's word has the upper 24 bits of z [m] and the
// surface's number, packed as in warp_surface.glsl. A second word has the index of the triangle.
// A triangle replaces a pixel's word only if its own word is smaller. So the nearest surface
// remains in any order of drawing.

inline constexpr std::uint32_t kNoSurface = 0xFFFFFFFF;
/// This bit marks the words of the shadow catcher. They are larger than all words of objects, so
/// objects hide the shadow catcher. The bit is free: it is the sign of z, and z is never negative.
inline constexpr std::uint32_t kBehindObjects = 0x80000000;

struct MeshRows {
    const float *x, *y, *z;
};
/// Projected corners. x, y: position on the grid [grid px]; pixel i extends from i to i + 1. z [m]
/// may have any sign. x and y are valid only if z > 0.
struct CornerRows {
    float *x, *y, *z;
};
/// Projects `count` corners through a lens, onto a grid with twice the resolution of the lens's
/// picture. Rows need AlignedRows::kPadding bytes of padding.
void projectCorners(const MeshRows& mesh, int count, const PointTransform& view,
                    const PointLens& lens, const CornerRows& out);

struct RasterCorner {
    float x, y;
    float perZ;
    float u = 0, v = 0;  ///< texture coordinates, divided by z
};

/// A linear function on the grid: its value at the centre of pixel (0, 0), and its change per
/// pixel.
struct RasterPlane {
    float first = 0, perX = 0, perY = 0;
};

/// A prepared triangle. x along an edge is always computed from the upper to the lower corner. So
/// two triangles get the same x at their common edge, and no pixel is omitted or drawn twice there.
struct RasterTriangle {
    float top, middle, bottom;
    float longX, upperX, lowerX;  ///< x at the upper end of each edge
    float longSlope, upperSlope, lowerSlope;
    int firstRow, lastRow;  ///< first row whose centre is covered; last such row + 1
    RasterPlane perZ;
    float leastPerZ, mostPerZ;
    std::uint32_t word;  ///< surface number; the shadow catcher's also has kBehindObjects
    std::uint32_t index;
    bool longIsLeft;
};

/// Alpha mask of a surface with transparent parts: a texture whose alpha decides where the surface
/// is drawn.
struct RasterMask {
    const std::uint8_t* rgba;
    Size size;
    float cutoff;  ///< texels with smaller alpha are transparent; above 1: all texels
};
struct MaskedTriangle {
    RasterTriangle triangle;
    RasterPlane u, v;  ///< texture coordinates divided by z
    RasterMask mask;
};

struct RasterName {
    std::uint32_t word, index;
};

/// Prepares a triangle for drawing. Returns false if it covers no row's centre or has no area.
[[nodiscard]] bool makeTriangle(const RasterCorner (&corners)[3], const RasterName& name,
                                RasterTriangle& out);
[[nodiscard]] bool makeMasked(const RasterCorner (&corners)[3], const RasterName& name,
                              const RasterMask& mask, MaskedTriangle& out);

/// Returns twice the signed area of the triangle on the grid. It is positive if the corners are
/// clockwise in the picture (row 0 is on top); then the triangle faces away.
[[nodiscard]] float doubleArea(const RasterCorner (&corners)[3]);
[[nodiscard]] RasterPlane planeThrough(const RasterCorner (&corners)[3], const float (&value)[3],
                                       float doubleArea);

/// Adjacent rows of the grid, in which one thread draws.
struct RasterBand {
    Rows<std::uint32_t> words;
    Rows<std::uint32_t> indices;  ///< valid where a triangle was drawn into `words`
    PixelRect where;
};
void drawTriangles(std::span<const RasterTriangle> triangles, const RasterBand& band);
void drawMasked(std::span<const MaskedTriangle> triangles, const RasterBand& band);
/// clearBand() fills the band's words with kNoSurface. After drawing, finishBand() replaces
/// kNoSurface by 0 and clears the bit kBehindObjects in all words.
void clearBand(const RasterBand& band);
void finishBand(const RasterBand& band);

}  // namespace mfar::simd
