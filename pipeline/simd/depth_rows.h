#pragma once

#include "base/geometry.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A rotation (row-major) and a translation of points.
struct Motion {
    std::array<float, 9> turn;
    std::array<float, 3> move;
};

/// Pixels of another camera's picture on which points with inverse depth `s` land: R (r + s (t - r
/// t.z)), see EpipolarLens. `motion.move` is t, which is applied before the rotation.
void landRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing);

/// The scene's points at a row of pixels. A point is known if its variance is finite.
struct DepthPoints {
    const float *raysX, *raysY;  ///< through the pixel centres
    const float *x, *y;          ///< offset of the point from the pixel's centre [px]
    const float *inverseDepth, *variance;
};
/// The same points, seen by another camera.
struct MovedPoints {
    std::int32_t* pixel;  ///< row-major index of the pixel that shows it; -1: invalid
    float *x, *y;         ///< offset from that pixel's centre [px]
    float *inverseDepth, *variance;
};
struct MoveRule {
    float pixelX, pixelY;  ///< change of the ray per pixel
    float leastDepth;      ///< least depth after the motion, as a share of the depth before
    float growth;          ///< added variance, as a share of the squared inverse depth
};
/// Moves points (x, y, 1, inverseDepth) in homogeneous coordinates. Extends `bounds` to the pixels
/// on which they land.
void moveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds);

/// The result of a search for a row of pixels.
struct SearchedRow {
    const float *raysX, *raysY, *s;
    const std::int32_t* landing;  ///< see landRow()
    const float* nearest;         ///< for each pixel of the other picture, the largest s that lands
                                  ///< on it
};
struct MeasureRule {
    std::array<float, 3> t;  ///< translation of points [units]
    float slack;             ///< difference of s between neighbours on one surface
    float leastDepth;        ///< least depth after the motion, as a share of the depth before
    float error;             ///< standard deviation of a match [rays]
    float perUnit;           ///< converts s [1/unit] to inverse depth [1/m]
};
/// Inverse depth s / (1 - s t.z) and its variance. They are 0 and infinity if the
/// other picture does not show the pixel, or if a change of s does not move the pixel.
void measureRow(const SearchedRow& row, const MeasureRule& rule, std::size_t count,
                float* inverseDepth, float* variance);

/// Replaces the inverse depth `own` of pixels [first, first + count) of row y by that of the cells
/// around each pixel (cells of 4x4 pixels, interpolated bilinearly), if the two differ by less than
/// `same`. `cells`: row-major, `size` of them.
struct CellField {
    const float* cells;
    Size size;
};
void takeCells(const CellField& field, int first, int y, const float* own, float same,
               std::size_t count, float* out);

}  // namespace mfar::simd
