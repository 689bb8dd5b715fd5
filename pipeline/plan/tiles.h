#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <cstddef>

namespace mfar {

inline constexpr int kTileSize = 16;  ///< edge of a tile [video px]

/// Numbers of tile columns and rows that cover a picture.
[[nodiscard]] constexpr Size tilesOf(Size pixels) {
    return {(pixels.width + kTileSize - 1) / kTileSize,
            (pixels.height + kTileSize - 1) / kTileSize};
}

/// What super-resolution does with a tile of 16x16 video pixels, in ascending order of cost.
enum class TileClass : unsigned {
    Unchanged = params::kTileUnchanged,  ///< video and still did not change: the last output stays
    Upscaled = params::kTileUpscaled,    ///< only enlarged: the still has no detail that fits
    Trusted = params::kTileTrusted,      ///< detail in the whole tile, with one smooth flow
    Blended = params::kTileBlended,      ///< detail with weight and flow that vary per pixel
    Hidden,                              ///< an opaque virtual object covers the tile
};
inline constexpr std::size_t kTileClasses = 5;

}  // namespace mfar
