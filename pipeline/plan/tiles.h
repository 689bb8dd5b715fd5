#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <cstddef>

namespace mfar {

inline constexpr int kTileSize = 16;  ///< video pixels

/// Columns and rows of the tiles that cover a picture.
[[nodiscard]] constexpr Size tilesOf(Size pixels) {
    return {(pixels.width + kTileSize - 1) / kTileSize,
            (pixels.height + kTileSize - 1) / kTileSize};
}

/// What the super-resolution does with a tile of 16x16 video pixels, cheapest first.
enum class TileClass : unsigned {
    Unchanged = params::kTileUnchanged,  ///< neither video nor still changed: the last output stays
    Upscaled = params::kTileUpscaled,    ///< the still has no detail to add, or none that fits
    Trusted = params::kTileTrusted,  ///< detail added everywhere in the tile with one smooth flow
    Blended = params::kTileBlended,  ///< detail added with a weight and flow that vary per pixel
    Hidden,                          ///< behind an opaque virtual object
};
inline constexpr std::size_t kTileClasses = 5;

}  // namespace mfar
