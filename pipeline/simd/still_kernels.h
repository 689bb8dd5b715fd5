#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Rows of a still. Rows that are written, and 16-bit and luma rows that are read, may be up to 64
// bytes behind their end.

/// Luma of Y in a plane, or in pairs of bytes with it first: gain [1/16384] Y + offset [1/32 grey
/// level] + `chroma` (likewise, null: nothing), clamped to [0, 255].
struct LumaGain {
    std::int16_t gain, offset;
};
void lumaOfPlane(const std::uint8_t* y, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma);
void lumaOfPairs(const std::uint8_t* yAndChroma, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma);

/// Luma whose finest detail is raised by what a linear look-up takes from it, clamped; see
/// still_raise.frag. `luma`: row above, this, below; also read beside. `neighboursShare` [1/32768].
void raisedRow(const std::array<const std::uint8_t*, 3>& luma, std::int16_t neighboursShare,
               std::size_t pixels, std::uint8_t* to);

/// Two rows as one of pairs, `upper` in the low bytes.
void pairRows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pixels,
              std::uint16_t* pairs);

/// Three rows as one of RGBA8, opaque.
void packRow(const std::array<const std::uint8_t*, 3>& rgb, std::size_t pixels,
             std::uint32_t* rgba);

}  // namespace mfar::simd
