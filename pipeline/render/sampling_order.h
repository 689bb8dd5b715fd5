#pragma once

#include <cstdint>

/// Order of the pixels in a tile of the path tracer (8x8 pixels). The class Slices lists the pixels
/// to be traced in this order. The class Film stores pixels in this order.
namespace mfar::sampling {

inline constexpr int kTileEdge = 8;  ///< [px]
inline constexpr int kTilePixels = kTileEdge * kTileEdge;

constexpr std::uint32_t spread(std::uint32_t v) {
    v = (v | v << 8) & 0x00ff00ff;
    v = (v | v << 4) & 0x0f0f0f0f;
    v = (v | v << 2) & 0x33333333;
    return (v | v << 1) & 0x55555555;
}

constexpr std::uint32_t mortonCode(int x, int y) {
    return spread(static_cast<std::uint32_t>(x)) | spread(static_cast<std::uint32_t>(y)) << 1;
}

/// Converts a pixel's rank in the sampling order to its Morton code in the tile. The ranks below
/// 4^n are spread evenly: if the tile is divided into 4^n equal squares, each square has one of
/// them. The function is its own inverse.
constexpr std::uint32_t evenlySpread(std::uint32_t rank) {
    return (rank & 0x03) << 4 | (rank & 0x0c) | (rank & 0x30) >> 4;
}

constexpr std::uint32_t rankOf(int x, int y) {
    return evenlySpread(mortonCode(x, y));
}

}  // namespace mfar::sampling
