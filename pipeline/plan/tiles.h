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
    Unchanged = params::kTileUnchanged,  ///< video and still did not change: the tile's pixels stay
    Upscaled = params::kTileUpscaled,    ///< the video is only enlarged: no detail of the still
                                         ///< fits
    Trusted = params::kTileTrusted,      ///< detail is drawn with a smooth flow and one weight for
                                         ///< the whole tile
    Blended = params::kTileBlended,      ///< detail is drawn with flow and weight that vary within
                                         ///< the tile
    Hidden,                              ///< an opaque virtual object covers the tile
};
inline constexpr std::size_t kTileClasses = 5;

}  // namespace mfar
