#pragma once

#include "pipeline/plan/tiles.h"

#include <algorithm>

namespace mfar {

/// Returns the number of output pixels before a tile along one axis. A pixel belongs to the tile
/// that contains its centre. `video`, `output`: sizes along this axis [px]. If `tile` is the number
/// of tiles, the result is `output`.
[[nodiscard]] constexpr int outputPixelsBefore(int tile, int video, int output) {
    const long edge = 2L * std::min(tile * kTileSize, video) * output;
    return static_cast<int>((edge + video - 1) / (2L * video));
}

}  // namespace mfar
