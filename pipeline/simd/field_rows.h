#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Computes the 3x3 median, multiplied by `scale`. The border is repeated outwards. Rows have
/// `width` values; `out` must not be one of the input rows.
void medianRow(const float* above, const float* here, const float* below, std::size_t width,
               float scale, float* out);

inline constexpr int kMostRange = 16;

/// Finds for each column the smallest and largest value within `radius` columns (at most
/// kMostRange). With `variance`, only valid values count (InverseDepthField::isSound()). If none is
/// valid, `low` is the largest float and `high` its negative.
void rangeAlongRow(const float* values, const float* variance, std::size_t width, int radius,
                   float* low, float* high);

void rangeAcrossRows(const float* low, const float* high, std::ptrdiff_t pitch, int rows,
                     std::size_t width, float* outLow, float* outHigh);

/// Returns the largest of the values, but at least 0.
[[nodiscard]] float greatestOf(const float* values, std::size_t count);

}  // namespace mfar::simd
