#pragma once

#include "base/geometry.h"
#include "pipeline/plan/tiles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// Work that each tile needs to draw a frame. WorkPlan writes it; all steps read it.
struct TileWork {
    enum class Draw : std::uint8_t {
        Tiles,  ///< only changed tiles are drawn
        /// The whole frame is drawn at once, with detail only in the rectangle detailTiles.
        Whole,
        /// The whole frame is enlarged at once. Detail is drawn only in matched tiles.
        WholeEnlarged
    };
    struct Tile {
        std::uint8_t changed = 0;  ///< the video differs from the video of the last drawing
        std::uint8_t matched = 0;  ///< the tile has structure and is matched with the still
    };

    Size tiles;
    std::vector<Tile> flags;
    int changed = 0;
    int matched = 0;
    Draw draw = Draw::Whole;
    PixelRect detailTiles;  ///< the smallest rectangle around all matched tiles [tiles]
    double noise = 0;

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
