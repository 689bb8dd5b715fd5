#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// The table of a RowTaps, in the form that resampleRow() reads. The RowTaps owns the memory.
struct TapTable {
    const std::int32_t* first;  ///< see RowTaps::first(); 64 bytes of padding repeat the last entry
    const float* weights;       ///< see RowTaps::weight(); one row per tap
    std::ptrdiff_t pitch;
    int taps;
};

// The three functions resampleRow() compute entries [begin, end) of a resampled row. They read up
// to 64 bytes beyond the source's end and write up to 64 bytes beyond `end`.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, float* to);
/// Rounds the resampled entries after multiplying them by `scale`.
void resampleRow(const float* source, const TapTable& taps, int begin, int end, float scale,
                 std::int16_t* to);
/// Rounds the resampled entries and clamps them to [0, 255].
void resampleRow(const float* source, const TapTable& taps, int begin, int end, std::uint8_t* to);

/// Writes entries [begin, end) of the weighted sum of `number` rows to `to`. Reads and writes up to
/// 64 bytes beyond `end`.
void weighRows(const std::int16_t* const* rows, const float* weights, int number, int begin,
               int end, float* to);
/// Like weighRows(), and also writes the weighted sum of the rows' squares to `squares`.
void weighRowsAndSquares(const std::int16_t* const* rows, const float* weights, int number,
                         int begin, int end, float* to, float* squares);
/// Replaces entries [begin, end) of `mean`, m, by m + light * (r - m), where r is the root of the
/// mean of the squares; see params::kSeen. Reads and writes up to 64 bytes beyond `end`.
void meanOfLightRow(const float* squares, float light, int begin, int end, float* mean);
/// Writes entries [0, count) of the weighted sum of `number` rows to `to`. Reads and writes up to
/// 64 bytes beyond `count`.
void weighRows(const std::uint8_t* const* rows, const float* weights, int number, int count,
               float* to);

}  // namespace mfar::simd
