#pragma once

#include "base/image_view.h"
#include "pipeline/engine/params/detail.h"

#include <cstddef>

namespace mfar {

inline constexpr int kTileSize = 16;  ///< [video px], along each axis

[[nodiscard]] constexpr Size tilesOf(Size pixels) {
    return {(pixels.width + kTileSize - 1) / kTileSize,
            (pixels.height + kTileSize - 1) / kTileSize};
}

/// Work that a tile needs, in ascending order of cost.
enum class TileClass : unsigned {
    Unchanged = params::kTileUnchanged,  ///< video and still did not change, the pixels stay
    /// only the video is enlarged, because no detail of the still fits
    Upscaled = params::kTileUpscaled,
    Trusted = params::kTileTrusted,  ///< detail is drawn with a smooth flow and one weight
    /// detail is drawn with flow and weight that vary within the tile
    Blended = params::kTileBlended,
    Hidden,  ///< an opaque virtual object covers the tile
};
inline constexpr std::size_t kTileClasses = 5;

}  // namespace mfar
