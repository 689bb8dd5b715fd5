#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Computes the median of 3x3 values around each column, multiplied by `scale`. Beyond the ends of
/// the rows, the outermost values count again. Rows have `width` values; `out` must not be one of
/// the input rows.
void medianRow(const float* above, const float* here, const float* below, std::size_t width,
               float scale, float* out);

inline constexpr int kMostRange = 16;

/// Finds for each column the smallest and the largest value at most `radius` columns away; `radius`
/// must not exceed kMostRange. If `variance` is not null, only values for which
/// InverseDepthField::isSound() is true count. If no value counts, `low` is the largest float and
/// `high` its negative.
void rangeAlongRow(const float* values, const float* variance, std::size_t width, int radius,
                   float* low, float* high);

/// Finds in each column the smallest `low` and the largest `high` of `rows` successive rows, which
/// are `pitch` entries apart.
void rangeAcrossRows(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
                     std::size_t width, float* outLow, float* outHigh);

/// Returns the largest of the values, but at least 0.
[[nodiscard]] float greatestOf(const float* values, std::size_t count);

}  // namespace mfar::simd
