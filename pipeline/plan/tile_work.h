#pragma once

#include "base/geometry.h"
#include "pipeline/plan/tiles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// What must be done in each tile to draw a frame. It is plain data in CPU memory, which WorkPlan
/// writes and every step reads.
struct TileWork {
    enum class Draw : std::uint8_t {
        Tiles,         ///< only changed tiles are drawn; the others keep the pixels of earlier
                       ///< frames
        Whole,         ///< the whole frame is drawn: detail in the rectangle detailTiles, enlarged
                       ///< video elsewhere
        WholeEnlarged  ///< the whole frame is enlarged; detail is drawn only in matched tiles
    };
    /// Flags of a tile, 1 or 0. `flags` is row-major.
    struct Tile {
        std::uint8_t changed = 0;  ///< the video differs from the video from which the tile was
                                   ///< last drawn
        std::uint8_t matched = 0;  ///< the tile has structure and is matched with the still
    };

    Size tiles;
    std::vector<Tile> flags;
    int changed = 0;  ///< number of changed tiles
    int matched = 0;  ///< number of changed tiles that are matched
    Draw draw = Draw::Whole;
    PixelRect detailTiles;  ///< the smallest rectangle around all matched tiles [tiles]
    double noise = 0;       ///< standard deviation of the video's noise [grey levels]

    /// Work in which every tile is changed and matched.
    [[nodiscard]] static TileWork everything(Size tiles) {
        const int count = tiles.width * tiles.height;
        return {tiles,
                std::vector<Tile>(static_cast<std::size_t>(count), Tile{1, 1}),
                count,
                count,
                Draw::Whole,
                {0, 0, tiles.width, tiles.height},
                0};
    }
    [[nodiscard]] const Tile& at(int column, int row) const {
        return flags[static_cast<std::size_t>(row) * tiles.width + column];
    }
    /// Whether this tile is drawn, either because the tile changed or because the whole frame is
    /// drawn.
    [[nodiscard]] bool draws(std::size_t tile) const {
        return drawsWhole() || flags[tile].changed != 0;
    }
    [[nodiscard]] bool drawsWhole() const { return draw != Draw::Tiles; }
};

}  // namespace mfar
