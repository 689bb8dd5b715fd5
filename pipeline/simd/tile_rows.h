#pragma once

#include "pipeline/plan/tile_measure.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kTileGroup = 16;  ///< number of tiles measured at a time

/// The pixels of adjacent tiles of a row in the new frame (`now`) and in the frame with which each
/// tile was last drawn (`drawn`). Each pixel row has 16 bytes per tile.
struct TilePixels {
    using Channels = std::array<std::array<const std::uint8_t*, kTileSize>, 3>;
    Channels now, drawn;
    int tiles;
};

/// Writes the TileMeasure of each tile to `out`. The results are bit-identical on every CPU.
void measureTileGroup(const TilePixels& pixels, const ChangeBounds& bounds, TileMeasure* out);

}  // namespace mfar::simd
