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

/// Counts for a frame, as in superres_classify.comp.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< count per TileClass
    int unexplained = 0;                    ///< tiles explained by no still
    int second = 0;                         ///< tiles in which the second still is shown
    /// Sum of eq. 2 over the cells of all tiles, in sixteenths, rounded down per tile: 256 per
    /// fully confident tile. Zero without a still.
    double confidence = 0;
};

/// Class of every tile of a frame; also remembers which tiles were unexplained when last drawn.
class TileClasses {
public:
    explicit TileClasses(Size video);

    /// Skipped work, see SkipOptions.
    struct Skips {
        bool upscaledTiles, plainTiles;
    };
    /// How a still matches; without data: no still.
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

    /// Whether the second still's share exceeds the first's somewhere in the tile.
    [[nodiscard]] bool showsSecond(int column, int row) const {
        return second_[static_cast<std::size_t>(row) * tiles_.width + column] != 0;
    }

private:
    struct Fields;
    void classifyRow(const TileWork& work, const Fields& fields, int row);

    Size tiles_;
    std::vector<TileClass> classes_;
    std::vector<int> unexplained_;      // unexplained cells per tile
    std::vector<std::uint8_t> second_;  // flags per tile
    std::vector<TileSummary> rowSums_;  // per row of tiles
};

}  // namespace mfar::simd
