#pragma once

#include "base/geometry.h"
#include "pipeline/plan/tiles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// The work of a frame, tile by tile: plain host data, made by WorkPlan, read by every step.
struct TileWork {
    enum class Draw : std::uint8_t {
        Tiles,         ///< changed tiles alone; the others keep their pixels of earlier frames
        Whole,         ///< the whole frame: detail inside detailTiles, enlarged video around it
        WholeEnlarged  ///< the whole frame enlarged, detail in the matched tiles alone
    };
    /// Flags are 1 or 0, row-major, one per tile.
    struct Tile {
        std::uint8_t changed = 0;  ///< the video differs from what was drawn there
        std::uint8_t matched = 0;  ///< has structure to match with the still
    };

    Size tiles;
    std::vector<Tile> flags;
    int changed = 0;  ///< number of changed tiles
    int matched = 0;  ///< number of changed tiles that are matched
    Draw draw = Draw::Whole;
    PixelRect detailTiles;  ///< [tiles]; the least rectangle that holds all matched tiles
    double noise = 0;       ///< standard deviation of the video's noise [grey levels]

    /// Every tile changed and matched.
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
    /// Is this tile drawn: because it changed, or because the whole frame is?
    [[nodiscard]] bool draws(std::size_t tile) const {
        return drawsWhole() || flags[tile].changed != 0;
    }
    [[nodiscard]] bool drawsWhole() const { return draw != Draw::Tiles; }
};

}  // namespace mfar
