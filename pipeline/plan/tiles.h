#pragma once

#include "base/image_view.h"

namespace mfar {

inline constexpr int kTileSize = 16;  ///< video pixels

/// Columns and rows of the tiles that cover a picture.
[[nodiscard]] constexpr Size tilesOf(Size pixels) {
    return {(pixels.width + kTileSize - 1) / kTileSize,
            (pixels.height + kTileSize - 1) / kTileSize};
}

}  // namespace mfar
