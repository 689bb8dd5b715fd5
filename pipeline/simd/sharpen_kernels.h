#pragma once

#include <array>
#include <cstdint>

namespace mfar::simd {

// One row of a colour channel for enlarging, entries [begin, end); see superres_sharpen.frag. Rows
// may be read and written up to 64 bytes behind `end`.

/// Strength of the sharpening, times 32767, from trust fields at the video's width: half of the
/// detail's weight and the signal's share, each in [0, 1], of two rows and in between.
struct TrustRows {
    std::array<const float*, 2> halfWeight, signal;
    float t;  ///< 0: the first row, 1: the second
};
void strengthRow(const TrustRows& trust, int begin, int end, std::int16_t* strength);

/// Sharpens the middle one of five rows. They are also read two bytes before `begin` and behind
/// `end`. Result in grey levels, clamped to [0, 255].
void sharpenRow(const std::array<const std::uint8_t*, 5>& rows, const std::int16_t* strength,
                int begin, int end, float* to);
/// As it is.
void plainRow(const std::uint8_t* row, int begin, int end, float* to);

}  // namespace mfar::simd
