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

/// Finds the pixels at which another camera shows the points on rays r with inverse depth `s`. The
/// other camera's ray is R (r + s (t - r t.z)), see EpipolarLens. R is `motion.turn`, t is
/// `motion.move`. `landing`: row-major indices; -1: outside the picture.
void landRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing);

/// The scene's points at a row of pixels. A point is known if its variance is finite.
struct DepthPoints {
    const float *raysX, *raysY;  ///< rays through the pixels' centres
    const float *x, *y;          ///< offset of the point from the pixel's centre [px]
    const float *inverseDepth, *variance;
};
/// The points of DepthPoints, seen by another camera.
struct MovedPoints {
    std::int32_t* pixel;  ///< row-major index of the pixel that shows the point; -1: invalid point
    float *x, *y;         ///< offset of the point from that pixel's centre [px]
    float *inverseDepth, *variance;
};
struct MoveRule {
    float pixelX, pixelY;  ///< change of a ray (x, y, 1) per pixel
    float leastDepth;      ///< smallest valid ratio of the depth after the motion to that before it
    float growth;          ///< variance added by the motion / squared inverse depth
};
/// Moves points (x, y, 1, inverseDepth) in homogeneous coordinates. Extends `bounds` to the pixels
/// on which they land.
void moveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds);

/// Inverse depths `s` that a search found for a row of pixels.
struct SearchedRow {
    const float *raysX, *raysY, *s;
    const std::int32_t* landing;  ///< see landRow()
    const float* nearest;         ///< for each pixel of the other picture, the largest s that lands
                                  ///< on it
};
struct MeasureRule {
    std::array<float, 3> t;  ///< translation of points [units], see landRow()
    float slack;             ///< largest difference of s [1/unit] within one surface
    float leastDepth;        ///< smallest valid 1 - s t.z, the ratio of the depths in both cameras
    float error;             ///< standard deviation of a match, as a change of the ray (x, y, 1)
    float perUnit;           ///< converts s [1/unit] to inverse depth [1/m]
};
/// Computes the inverse depth s / (1 - s t.z) of each pixel, and its variance. The inverse depth is
/// 0 and the variance infinite if the other picture does not show the pixel's point, or if a change
/// of s does not move the point in the other picture.
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
