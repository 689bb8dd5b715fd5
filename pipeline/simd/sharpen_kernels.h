#pragma once

#include <array>
#include <cstdint>

namespace mfar::simd {

// Functions that sharpen entries [begin, end) of a row of one colour channel
// (superres_sharpen.frag). Rows may be read and written up to 64 bytes beyond `end`.

/// Input of strengthRow(): rows with one value per video pixel. `halfWeight`: half of the weight of
/// the still's detail. `signal`: see TrustCell. Both are interpolated between two rows; `t` is the
/// weight of the second row.
struct TrustRows {
    std::array<const float*, 2> halfWeight, signal;
    float t;
};
/// Writes the strength of the sharpening at each video pixel, [0, 1], times 32767.
void strengthRow(const TrustRows& trust, int begin, int end, std::int16_t* strength);

/// Sharpens the middle one of five rows. Each row is also read two bytes before `begin` and two
/// after `end`. The result is in grey levels, clamped to [0, 255].
void sharpenRow(const std::array<const std::uint8_t*, 5>& rows, const std::int16_t* strength,
                int begin, int end, float* to);
void plainRow(const std::uint8_t* row, int begin, int end, float* to);

}  // namespace mfar::simd
