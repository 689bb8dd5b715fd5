#pragma once

#include "base/geometry.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Rotation matrix (row-major) and translation of points.
struct Motion {
    std::array<float, 9> turn;
    std::array<float, 3> move;
};

/// Finds the pixels at which another camera shows points with inverse depth `s` on rays r. The
/// other camera's ray is R (r + s (t - r t.z)), see EpipolarLens. R is `motion.turn`, t is
/// `motion.move`. `landing`: row-major pixel index, or -1 outside the picture.
void landRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing);

/// The scene's points at a row of pixels: rays through the pixels' centres, and offsets (x, y) of
/// the points from these centres [px]. A point is known if its variance is finite.
struct DepthPoints {
    const float *raysX, *raysY;
    const float *x, *y;
    const float *inverseDepth, *variance;
};
struct MovedPoints {
    /// Row-major index of the pixel that shows the point (-1: invalid point), and offset of the
    /// point from that pixel's centre [px].
    std::int32_t* pixel;
    float *x, *y;
    float *inverseDepth, *variance;
};
struct MoveRule {
    float pixelX, pixelY;  ///< change of a ray (x, y, 1) per pixel
    float leastDepth;      ///< smallest valid ratio (depth after the motion) / (depth before it)
    float growth;          ///< ratio (variance that the motion adds) / (inverse depth)^2
};
/// Moves points, given as (x, y, 1, inverseDepth) in homogeneous coordinates. Extends `bounds` to
/// the pixels on which the points land.
void moveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds);

struct SearchedRow {
    const float *raysX, *raysY, *s;
    const std::int32_t* landing;
    const float* nearest;  ///< largest s that lands on each pixel of the other picture
};
struct MeasureRule {
    std::array<float, 3> t;  ///< translation of points [units], see landRow()
    float slack;             ///< largest difference of s [1/unit] within one surface
    float leastDepth;        ///< smallest valid 1 - s t.z, the ratio of the depths in both cameras
    float error;             ///< standard deviation of a match, as a change of a ray (x, y, 1)
    float perUnit;           ///< converts s [1/unit] to inverse depth [1/m]
};
/// Computes the inverse depth s / (1 - s t.z) of each pixel, and its variance. A pixel gets inverse
/// depth 0 and infinite variance in two cases: the other picture does not show its point, or a
/// change of s does not move the point in the other picture.
void measureRow(const SearchedRow& row, const MeasureRule& rule, std::size_t count,
                float* inverseDepth, float* variance);

/// takeCells() replaces the inverse depth `own` of a pixel by the one interpolated bilinearly from
/// the cells around it, if both differ by less than `same`. It processes pixels [first, first +
/// count) of row y. `cells`: one inverse depth per 4x4 pixels, row-major.
struct CellField {
    const float* cells;
    Size size;
};
void takeCells(const CellField& field, int first, int y, const float* own, float same,
               std::size_t count, float* out);

}  // namespace mfar::simd
