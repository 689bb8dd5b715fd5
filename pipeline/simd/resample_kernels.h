#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// See RowTaps, which makes and owns it.
struct TapTable {
    const std::int32_t* first;  ///< ascending; 64 bytes behind the end repeat the last
    const float* weights;       ///< a row per tap
    std::ptrdiff_t pitch;       ///< floats from one row of weights to the next
    int taps;
};

// Entries [begin, end) of a resampled row. Reads up to 64 bytes behind the source's end, writes up
// to as many behind `end`.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, float* to);
/// Times `scale`, rounded.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, float scale,
                 std::int16_t* to);
/// Rounded and clamped.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, std::uint8_t* to);

/// Entries [begin, end) of the sum of rows, each times its weight. Reads and writes up to 64 bytes
/// behind `end`.
void weighRows(const std::int16_t* const* rows, const float* weights, int number, int begin,
               int end, float* to);
/// Entries [0, count) of the sum of rows, each times its weight. Reads and writes up to 64 bytes
/// behind their ends.
void weighRows(const std::uint8_t* const* rows, const float* weights, int number, int count,
               float* to);

}  // namespace mfar::simd
