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

/// What the still's luma has beyond the video's resolution, + 128, clamped; see still_detail.frag.
struct StillRows {
    std::array<const std::uint8_t*, 3> luma;  ///< row above, this, below; also read beside
    std::array<const std::int16_t*, 4> low;   ///< rows at the video's scale [1/64 grey level]
    std::array<std::int16_t, 4> weights;      ///< of these [1/16384]
    std::int16_t neighboursShare;             ///< [1/32768]
};
void stillDetailRow(const StillRows& rows, std::size_t pixels, std::uint8_t* detail);

/// Luma whose finest detail is raised by what a linear look-up takes from it, clamped. `luma` and
/// `share` as in StillRows.
void raisedRow(const std::array<const std::uint8_t*, 3>& luma, std::int16_t neighboursShare,
               std::size_t pixels, std::uint8_t* to);

/// Two rows as one of pairs, `upper` in the low bytes.
void pairRows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pixels,
              std::uint16_t* pairs);

/// Three rows as one of RGBA8, opaque.
void packRow(const std::array<const std::uint8_t*, 3>& rgb, std::size_t pixels,
             std::uint32_t* rgba);

}  // namespace mfar::simd
