#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Functions of the learned enlarger for pixels [begin, end) of a row; see filter_layout.h. Luma is
// in 1/8 grey level and is read up to three pixels before `begin` and after `end`. Vectors can
// read and write up to 64 bytes after these pixels, in all rows except `rgb`.

void lumaEighthsRow(const std::array<const std::uint8_t*, 3>& rgb, int begin, int end,
                    std::int16_t* to);

/// Writes the gradient class and the curvature class of each pixel, numbered as in GradientClasses
/// and CurvatureClasses. `luma`: seven rows with this row in the middle. `sums`: three temporary
/// rows, used from two pixels before `begin` to two pixels after `end`.
void classRow(const std::array<const std::int16_t*, 7>& luma, int begin, int end,
              const std::array<float*, 3>& sums, std::uint16_t* gradient, std::uint16_t* curvature);

/// Writes for each pixel the lowest and the highest value that the enlarged picture's luma may have
/// there. Both are relative to the pixel's own luma [1/8 grey level]. They are the range of the 5x5
/// pixels around the pixel, extended by the allowed overshoot (kOvershootShift).
void rangeRow(const std::array<const std::int16_t*, 5>& luma, int begin, int end,
              std::int16_t* lowest, std::int16_t* highest);

/// The filters of a FilterBank. The pitch of `gradient` and of `curvature` is the distance between
/// the filters of successive classes [coefficients].
struct FilterRows {
    const std::int16_t *gradient, *curvature, *cubic;
    std::ptrdiff_t gradientPitch, curvaturePitch;
};
/// Rows of luma with the pixels' row in the middle, and results of classRow() and rangeRow().
struct ResidualInput {
    std::array<const std::int16_t*, 5> luma;
    const std::uint16_t *gradient, *curvature;
    const std::int16_t *lowest, *highest;
};
/// Computes the residual that the learned filters add to cubic interpolation [1/32 grey level]. It
/// has one value per sub-pixel. `to`: four rows of sub-pixels, with four values per pixel.
void residualRows(const ResidualInput& in, const FilterRows& filters, int begin, int end,
                  const std::array<std::int16_t*, 4>& to);

/// Writes a + t (b - a).
void mixedRow(const std::int16_t* a, const std::int16_t* b, float t, int begin, int end, float* to);

}  // namespace mfar::simd
