#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Median of 3x3 values times `scale`; the border repeats. Rows have `width` values; `out` must be
/// none of the input rows.
void medianRow(const float* above, const float* here, const float* below, std::size_t width,
               float scale, float* out);

inline constexpr int kMostRange = 16;  ///< largest radius of a range

/// Smallest and largest value within `radius` columns. With `variance`: only of values that are
/// valid (InverseDepthField::isSound()); if none is, +- the largest float.
void rangeAlongRow(const float* values, const float* variance, std::size_t width, int radius,
                   float* low, float* high);

/// Smallest of `low` and largest of `high` over `rows` rows, `pitch` apart.
void rangeAcrossRows(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
                     std::size_t width, float* outLow, float* outHigh);

/// Largest of the values and 0.
[[nodiscard]] float greatestOf(const float* values, std::size_t count);

}  // namespace mfar::simd
