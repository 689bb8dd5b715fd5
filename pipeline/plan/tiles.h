#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <cstddef>

namespace mfar {

inline constexpr int kTileSize = 16;  ///< width and height of a tile [video px]

[[nodiscard]] constexpr Size tilesOf(Size pixels) {
    return {(pixels.width + kTileSize - 1) / kTileSize,
            (pixels.height + kTileSize - 1) / kTileSize};
}

/// Work that a tile needs. The classes are in ascending order of cost. Unchanged: video and still
/// did not change, and the pixels stay. Upscaled: the video is enlarged, and no detail is added,
/// because none of the still fits. Trusted: detail is drawn with a smooth flow and one weight.
/// Blended: detail is drawn with flow and weight that vary within the tile.
enum class TileClass : unsigned {
    Unchanged = params::kTileUnchanged,
    Upscaled = params::kTileUpscaled,
    Trusted = params::kTileTrusted,
    Blended = params::kTileBlended,
};
inline constexpr std::size_t kTileClasses = 4;

}  // namespace mfar
