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
/// did not change, and the pixels stay. Enlarged: the video is enlarged, and no detail is added,
/// because the tile was not matched or the still does not fit. Trusted: detail is drawn with an
/// affine flow and a uniform weight (within tolerances, see params::kPlainFlow). Blended: detail is
/// drawn with flow and weight that vary within the tile.
enum class TileClass : unsigned {
    Unchanged = params::kTileUnchanged,
    Enlarged = params::kTileEnlarged,
    Trusted = params::kTileTrusted,
    Blended = params::kTileBlended,
};
inline constexpr std::size_t kTileClasses = 4;

}  // namespace mfar
