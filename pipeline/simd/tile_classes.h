#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar::simd {

/// Numbers of tiles in a frame, computed as in superres_classify.comp.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};
    int unexplained = 0;  ///< number of tiles with many cells that match neither still
    int second = 0;
    /// Sum, over all tiles, of 256 times the mean confidence (eq. 2 of the paper) of the tile's
    /// cells. Each tile's part is rounded down to a whole number. Zero if there is no still.
    double confidence = 0;
};

/// Determines the TileClass of every tile of a frame. Remembers for each tile the number of cells
/// that had no trusted match in either still when the tile was last drawn.
class TileClasses {
public:
    explicit TileClasses(Size video);

    struct Skips {
        bool upscaledTiles, plainTiles;
    };
    /// Match of a still with the frame. If the fields have no data, there is no such still.
    struct Match {
        Rows<const WeighedCell> weighed{};
        Rows<const TrustCell> trust{};
    };
    TileSummary classify(const TileWork& work, const Match& match, const Match& second, Skips skips,
                         Workers& workers);

    [[nodiscard]] const std::vector<TileClass>& classes() const { return classes_; }
    [[nodiscard]] TileClass at(int column, int row) const {
        return classes_[static_cast<std::size_t>(row) * tiles_.width + column];
    }

    /// True if the still's detail has a weight of at least one in every cell in and next to the
    /// tile. It then replaces the video's detail completely, and learned filters would add nothing.
    [[nodiscard]] bool showsStillAlone(int column, int row) const {
        return alone_[static_cast<std::size_t>(row) * tiles_.width + column] != 0;
    }
    /// True if the second still's weight exceeds the first still's by more than params::kSecondFrom
    /// in any cell in or next to the tile.
    [[nodiscard]] bool showsSecond(int column, int row) const {
        return second_[static_cast<std::size_t>(row) * tiles_.width + column] != 0;
    }

private:
    struct Fields;
    void classifyRow(const TileWork& work, const Fields& fields, int row);

    Size tiles_;
    std::vector<TileClass> classes_;
    std::vector<int> unexplained_;  // number of a tile's cells that match neither still
    std::vector<std::uint8_t> second_, alone_;
    std::vector<TileSummary> rowSums_;
};

}  // namespace mfar::simd
