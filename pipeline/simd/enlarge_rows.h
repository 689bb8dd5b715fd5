#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Functions of the learned enlarger for pixels [begin, end) of a row; see pipeline/enlarge. Luma is
// in 1/8 grey level and is read up to three pixels before `begin` and after `end`. All rows except
// the colours may be read and written up to 64 bytes beyond these pixels.

void lumaEighthsRow(const std::array<const std::uint8_t*, 3>& rgb, int begin, int end,
                    std::int16_t* to);

/// Writes the gradient class and the curvature class of each pixel, numbered as in GradientClasses
/// and CurvatureClasses. `luma`: seven rows with this row in the middle. `sums`: three temporary
/// rows, used from two pixels before `begin` on.
void classRow(const std::array<const std::int16_t*, 7>& luma, int begin, int end,
              const std::array<float*, 3>& sums, std::uint16_t* gradient, std::uint16_t* curvature);

/// Writes the lowest and highest luma that the enlarged picture may have in a pixel, relative to
/// the pixel's luma [1/8 grey level]. They are the range of the 5x5 pixels around it, extended by
/// the allowed overshoot.
void rangeRow(const std::array<const std::int16_t*, 5>& luma, int begin, int end,
              std::int16_t* lowest, std::int16_t* highest);

/// The filters of a FilterBank. The filters of successive classes are gradientPitch coefficients
/// apart in `gradient`, and curvaturePitch coefficients apart in `curvature`.
struct FilterRows {
    const std::int16_t *gradient, *curvature, *cubic;
    std::ptrdiff_t gradientPitch, curvaturePitch;
};
struct ResidualInput {
    std::array<const std::int16_t*, 5> luma;
    const std::uint16_t *gradient, *curvature;
    const std::int16_t *lowest, *highest;
};
/// Computes what the learned filters add to cubic interpolation [1/32 grey level], on a grid of 4x4
/// sub-pixels per pixel. Writes four rows, with four values per pixel.
void residualRows(const ResidualInput& in, const FilterRows& filters, int begin, int end,
                  const std::array<std::int16_t*, 4>& to);

void mixedRow(const std::int16_t* a, const std::int16_t* b, float t, int begin, int end, float* to);

}  // namespace mfar::simd
