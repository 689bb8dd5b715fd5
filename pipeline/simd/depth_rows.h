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

/// Finds the pixels at which another camera shows points. A point has the inverse depth `s` and
/// lies on the ray r = (raysX, raysY, 1) of this camera. Its ray in the other camera is turn * (r +
/// s (move - r move.z)), see EpipolarLens. `size`: size of the other camera's picture. `landing`:
/// row-major index of the pixel, or -1 if the point is not in that picture.
void landRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing);

/// Points of the scene, one for each pixel of a row. raysX, raysY: rays through the pixels'
/// centres. x, y: offsets of the points from these centres [px]. A point is known if its variance
/// is finite.
struct DepthPoints {
    const float *raysX, *raysY;
    const float *x, *y;
    const float *inverseDepth, *variance;
};
struct MovedPoints {
    std::int32_t* pixel;  ///< row-major index of the pixel that shows the point; -1: invalid point
    float *x, *y;         ///< offset of the point from that pixel's centre [px]
    float *inverseDepth, *variance;
};
struct MoveRule {
    float pixelX, pixelY;  ///< change of a ray's x per column, and of its y per row
    /// A moved point is valid only if (depth after the motion) / (depth before it) exceeds this.
    float leastDepth;
    float growth;  ///< variance that the motion adds, divided by (inverse depth)^2
};
/// Moves points by `motion` and projects them into a picture of `size`. A point on the ray (x, y,
/// 1) has the homogeneous coordinates (x, y, 1, inverseDepth). `bounds` grows to contain the pixels
/// of all valid moved points.
void moveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds);

struct SearchedRow {
    const float *raysX, *raysY, *s;
    const std::int32_t* landing;  ///< result of landRow()
    const float* nearest;         ///< nearest[k]: largest s of all points with landing k
};
struct MeasureRule {
    std::array<float, 3> t;  ///< translation of points [units of length], see landRow()
    float slack;             ///< a point with s < nearest - slack is hidden [1/unit of length]
    /// A pixel is valid only if (depth in this camera) / (depth in the other) exceeds this.
    float leastDepth;
    float error;    ///< standard deviation of a match's position [focal lengths]
    float perUnit;  ///< converts s [1/unit of length] to inverse depth [1/m]
};
/// Computes the inverse depth perUnit * s / (1 - s t.z) [1/m] of each pixel, but at least 0, and
/// the variance of the inverse depth [1/m^2]. An invalid pixel gets inverse depth 0 and infinite
/// variance. A pixel is valid if the other picture shows its point, 1 - s t.z exceeds `leastDepth`,
/// and a change of s moves the point in that picture. For perUnit, t and leastDepth, see
/// MeasureRule.
void measureRow(const SearchedRow& row, const MeasureRule& rule, std::size_t count,
                float* inverseDepth, float* variance);

/// Inverse depths of the cells of a picture, row-major. takeCells() interpolates them bilinearly at
/// the pixels [first, first + count) of row y. A pixel gets the interpolated value if that differs
/// from the pixel's `own` value by less than `same`. Otherwise it keeps its `own` value.
struct CellField {
    const float* cells;
    Size size;
};
void takeCells(const CellField& field, int first, int y, const float* own, float same,
               std::size_t count, float* out);

}  // namespace mfar::simd
