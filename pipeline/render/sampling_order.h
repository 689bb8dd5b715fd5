#pragma once

#include <cstdint>

/// The order in which the pixels of a tile are sampled: Slices samples, and Film stores, in this
/// order.
namespace mfar::sampling {

inline constexpr int kTileEdge = 8;  ///< [px]
inline constexpr int kTilePixels = kTileEdge * kTileEdge;

/// Puts a zero bit between adjacent bits of the lower 16 bits.
constexpr std::uint32_t spread(std::uint32_t v) {
    v = (v | v << 8) & 0x00ff00ff;
    v = (v | v << 4) & 0x0f0f0f0f;
    v = (v | v << 2) & 0x33333333;
    return (v | v << 1) & 0x55555555;
}

constexpr std::uint32_t mortonCode(int x, int y) {
    return spread(static_cast<std::uint32_t>(x)) | spread(static_cast<std::uint32_t>(y)) << 1;
}

/// Morton code of the pixel with number `rank` in its tile's sampling order. Each of the first 4^n
/// pixels lies in a different square of an even grid. The function is its own inverse.
constexpr std::uint32_t evenlySpread(std::uint32_t rank) {
    return (rank & 0x03) << 4 | (rank & 0x0c) | (rank & 0x30) >> 4;
}

/// Number of the pixel (x, y) of a tile in the sampling order.
constexpr std::uint32_t rankOf(int x, int y) {
    return evenlySpread(mortonCode(x, y));
}

}  // namespace mfar::sampling
