#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Functions of the learned enlarger for pixels [begin, end) of a row; see pipeline/enlarge. Luma is
// in 1/8 grey level and is read up to three pixels before `begin` and after `end`. All rows except
// the colours may be read and written up to 64 bytes beyond that.

/// Rec. 601 luma of red, green and blue.
void lumaEighthsRow(const std::array<const std::uint8_t*, 3>& rgb, int begin, int end,
                    std::int16_t* to);

/// Classes of the pixels of the middle one of seven rows, numbered as in GradientClasses and
/// CurvatureClasses. `sums`: three temporary rows, used from two pixels before `begin` on.
void classRow(const std::array<const std::int16_t*, 7>& luma, int begin, int end,
              const std::array<float*, 3>& sums, std::uint16_t* gradient, std::uint16_t* curvature);

/// Limits of luma plus residual, relative to the pixel's luma [1/8 grey level]: the range of its
/// 5x5 pixels, extended by the allowed overshoot.
void rangeRow(const std::array<const std::int16_t*, 5>& luma, int begin, int end,
              std::int16_t* lowest, std::int16_t* highest);

/// The filters: rows of FilterBank, which are `pitch` numbers apart.
struct FilterRows {
    const std::int16_t *gradient, *curvature, *cubic;
    std::ptrdiff_t gradientPitch, curvaturePitch;
};
/// Input for the residual of a row of pixels.
struct ResidualInput {
    std::array<const std::int16_t*, 5> luma;
    const std::uint16_t *gradient, *curvature;
    const std::int16_t *lowest, *highest;
};
/// Writes four rows of the grid of sub-pixels, with four values per pixel [1/32 grey level].
void residualRows(const ResidualInput& in, const FilterRows& filters, int begin, int end,
                  const std::array<std::int16_t*, 4>& to);

/// Interpolates between two rows: a + t (b - a).
void mixedRow(const std::int16_t* a, const std::int16_t* b, float t, int begin, int end, float* to);

}  // namespace mfar::simd
