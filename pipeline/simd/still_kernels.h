#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Rows of a still. Written rows, and 16-bit and luma rows that are read, may be accessed up to 64
// bytes beyond their end.

/// Luma from Y, stored as a plane or as byte pairs with Y first: gain [1/16384] Y + offset [1/32
/// grey level] + `chroma` [1/32 grey level] (null: 0), clamped to [0, 255].
struct LumaGain {
    std::int16_t gain, offset;
};
void lumaOfPlane(const std::uint8_t* y, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma);
void lumaOfPairs(const std::uint8_t* yAndChroma, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma);

/// Luma with its finest detail raised to compensate for the loss in a linear look-up, clamped; see
/// still_raise.frag. `luma`: the rows above, here and below; also reads one pixel to each side.
/// `neighboursShare` [1/32768].
void raisedRow(const std::array<const std::uint8_t*, 3>& luma, std::int16_t neighboursShare,
               std::size_t pixels, std::uint8_t* to);

/// Packs two rows into one row of pairs, `upper` in the low bytes.
void pairRows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pixels,
              std::uint16_t* pairs);

/// Packs three rows into one of opaque RGBA8.
void packRow(const std::array<const std::uint8_t*, 3>& rgb, std::size_t pixels,
             std::uint32_t* rgba);

}  // namespace mfar::simd
