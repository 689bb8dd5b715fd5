#pragma once

#include "pipeline/plan/tile_measure.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

inline constexpr int kTileGroup = 16;  ///< number of tiles measured at a time

/// Adjacent tiles in both pictures: 16 bytes of each row for each tile.
struct TilePixels {
    /// Rows of red, green and blue.
    using Channels = std::array<std::array<const std::uint8_t*, kTileSize>, 3>;
    Channels now, drawn;
    int tiles;  ///< up to kTileGroup
};

/// Measures each tile. The result is bit-identical on every CPU.
void measureTileGroup(const TilePixels& pixels, const ChangeBounds& bounds, TileMeasure* out);

}  // namespace mfar::simd
