#pragma once

#include "base/geometry.h"
#include "pipeline/simd/lens.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A turn and a move of points, row-major.
struct Motion {
    std::array<float, 9> turn;
    std::array<float, 3> move;
};

/// Where points s of pixels land in a picture of another camera: turn (r + s (t - r t.z)), see
/// EpipolarLens; `motion.move` is t, before the turn.
void landRow(const Lens& lens, Size size, const Motion& motion, const float* raysX,
             const float* raysY, const float* s, std::size_t count, std::int32_t* landing);

/// The scene's points of a row of pixels, known where their variance is finite.
struct DepthPoints {
    const float *raysX, *raysY;  ///< of the pixels' middles
    const float *x, *y;          ///< from there [px]
    const float *rho, *variance;
};
/// The same as another camera sees them.
struct MovedPoints {
    std::int32_t* pixel;  ///< row-major; -1: invalid
    float *x, *y;         ///< from its middle [px]
    float *rho, *variance;
};
struct MoveRule {
    float pixelX, pixelY;  ///< rays a pixel
    float leastDepth;      ///< share of the depth before
    float growth;          ///< of variance, by the square of rho
};
/// Points are homogeneous, (x, y, 1, rho). Adds what they land on to `bounds`.
void moveRow(const Lens& lens, Size size, const Motion& motion, const MoveRule& rule,
             const DepthPoints& from, std::size_t count, const MovedPoints& to, PixelRect& bounds);

/// What a search says of a row of pixels.
struct SearchedRow {
    const float *raysX, *raysY, *s;
    const std::int32_t* landing;  ///< landRow()
    const float* nearest;         ///< of the other picture: greatest s that lands on each pixel
};
struct MeasureRule {
    std::array<float, 3> t;  ///< translation of points [units]
    float slack;             ///< s that neighbours on one surface may differ by
    float leastDepth;        ///< after the move, share of the depth before
    float error;             ///< standard deviation of a match [rays]
    float perUnit;           ///< s [1/unit] to rho [1/m]
};
/// rho = s / (1 - s t.z) and its variance; 0 and infinite where the other picture does not show the
/// pixel, or the pixel does not move.
void measureRow(const SearchedRow& row, const MeasureRule& rule, std::size_t count, float* rho,
                float* variance);

/// Takes s of cells of 4x4 pixels, bilinear, where that differs from the pixels' own by less than
/// `same`. Pixels [first, first + count) of row y; `cells`: `size` of them, row-major.
struct CellField {
    const float* cells;
    Size size;
};
void takeCells(const CellField& field, int first, int y, const float* own, float same,
               std::size_t count, float* out);

}  // namespace mfar::simd
