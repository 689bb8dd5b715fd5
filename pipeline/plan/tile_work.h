#pragma once

#include "base/geometry.h"
#include "pipeline/plan/tiles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// Work that each tile needs to draw a frame. WorkPlan and SecondTiles write it; all steps read it.
struct TileWork {
    enum class Draw : std::uint8_t {
        Tiles,  ///< only tiles with the flag `changed` are drawn
        /// The whole frame is drawn at once, with detail only in the rectangle detailTiles.
        Whole,
        /// The whole frame is enlarged at once. Detail is drawn only in matched tiles.
        WholeEnlarged
    };
    struct Tile {
        /// 1 if the tile must be drawn again: its video changed, the overlay on it must be drawn
        /// again (see WorkPlan::Redraw), or a redraw of the whole frame was requested.
        std::uint8_t changed = 0;
        std::uint8_t matched = 0;  ///< 1 if the tile has structure and is matched with the still
    };

    Size tiles;
    std::vector<Tile> flags;
    int changed = 0;  ///< number of changed tiles
    int matched = 0;  ///< number of tiles that are changed and matched
    Draw draw = Draw::Whole;
    /// A rectangle around all matched tiles [tiles]. It is the smallest one if WorkPlan may choose
    /// Draw::WholeEnlarged; otherwise it contains all tiles.
    PixelRect detailTiles;
    double noise = 0;  ///< standard deviation of the video's noise [grey levels]

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
    [[nodiscard]] bool draws(std::size_t tile) const {
        return drawsWhole() || flags[tile].changed != 0;
    }
    [[nodiscard]] bool drawsWhole() const { return draw != Draw::Tiles; }
};

}  // namespace mfar
