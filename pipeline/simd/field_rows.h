#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Median over 3x3 values times `scale`; the border repeats. Rows of `width`, none of them `out`.
void medianRow(const float* above, const float* here, const float* below, std::size_t width,
               float scale, float* out);

inline constexpr int kMostRange = 16;  ///< largest radius of a range

/// Least and greatest of the values within `radius` columns. With `variance`: of those that are
/// sound (InverseDepthField::isSound()), without any +- the largest number.
void rangeAlongRow(const float* values, const float* variance, std::size_t width, int radius,
                   float* low, float* high);

/// Least of `low` and greatest of `high` over `rows` rows; `pitch` between them.
void rangeAcrossRows(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
                     std::size_t width, float* outLow, float* outHigh);

/// Greatest of the values and of 0.
[[nodiscard]] float greatestOf(const float* values, std::size_t count);

}  // namespace mfar::simd
