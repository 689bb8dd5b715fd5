#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// A resampling table. RowTaps creates and owns it.
struct TapTable {
    const std::int32_t* first;  ///< see RowTaps::first(); 64 bytes of padding repeat the last entry
    const float* weights;       ///< see RowTaps::weight(); one row per tap
    std::ptrdiff_t pitch;
    int taps;
};

// The three functions resampleRow() compute entries [begin, end) of a resampled row. They read up
// to 64 bytes beyond the source's end and write up to 64 bytes beyond `end`.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, float* to);
/// Writes the resampled entries times `scale`, rounded.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, float scale,
                 std::int16_t* to);
/// Writes the resampled entries as bytes, rounded and clamped to [0, 255].
void resampleRow(const float* source, const TapTable& taps, int begin, int end, std::uint8_t* to);

/// Computes entries [begin, end) of a weighted sum of rows. Reads and writes up to 64 bytes beyond
/// `end`.
void weighRows(const std::int16_t* const* rows, const float* weights, int number, int begin,
               int end, float* to);
/// Computes entries [0, count) of a weighted sum of rows. Reads and writes up to 64 bytes beyond
/// their ends.
void weighRows(const std::uint8_t* const* rows, const float* weights, int number, int count,
               float* to);

}  // namespace mfar::simd
