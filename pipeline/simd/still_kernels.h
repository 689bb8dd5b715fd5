#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar::simd {

// Functions for rows of a still. Rows need 64 more bytes after their end, because the last vector
// may reach beyond the end. Exception: the rows of Y, or of Y and chroma, that lumaOfPlane() and
// lumaOfPairs() read from the camera's picture.

/// Parameters of lumaOfPlane() and lumaOfPairs(), which compute luma from Y and chroma.
/// lumaOfPlane() reads a plane of Y; lumaOfPairs() reads byte pairs with Y first. The result is Y *
/// gain / 16384 + (offset + chroma) / 32 [grey levels], clamped to [0, 255]. A null `chroma` counts
/// as 0.
struct LumaGain {
    std::int16_t gain, offset;
};
void lumaOfPlane(const std::uint8_t* y, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma);
void lumaOfPairs(const std::uint8_t* yAndChroma, const std::int16_t* chroma, const LumaGain& by,
                 std::size_t pixels, std::uint8_t* luma);

/// Computes luma with amplified finest detail, to compensate for the loss in a linear look-up
/// (still_raise.frag). The result is clamped to [0, 255]. `luma`: the row and those above and below
/// it, which are also read one pixel beyond each end. `neighboursShare`: weight of a neighbour
/// [1/32768].
void raisedRow(const std::array<const std::uint8_t*, 3>& luma, std::int16_t neighboursShare,
               std::size_t pixels, std::uint8_t* to);

/// Removes noise from a row of luma. The difference between a pixel and the mean of its 3x3
/// neighbourhood is reduced by the share noise / max(variance, noise), where `variance` is the
/// variance in the neighbourhood (Wiener filter, still_quiet.frag). `noise` [grey levels^2] must be
/// positive. `luma`: as in raisedRow().
void quietRow(const std::array<const std::uint8_t*, 3>& luma, float noise, std::size_t pixels,
              std::uint8_t* to);

/// Packs two rows of bytes into one row of pairs. `upper` becomes the low bytes.
void pairRows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t pixels,
              std::uint16_t* pairs);

void packRow(const std::array<const std::uint8_t*, 3>& rgb, std::size_t pixels,
             std::uint32_t* rgba);

}  // namespace mfar::simd
