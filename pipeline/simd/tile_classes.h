#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/tile_work.h"
#include "pipeline/plan/tiles.h"

#include <array>
#include <vector>

namespace mfar::simd {

/// Counts of a frame, as superres_classify.comp makes them.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< count per TileClass
    int unexplained = 0;                    ///< tiles that the still does not show
    /// Sum of eq. 2 over the cells of all tiles, in sixteenths, each tile's rounded down: 256 a
    /// tile where all is sure. Zero without a still.
    double confidence = 0;
};

/// Class of every tile of a frame; remembers which were unexplained when drawn last.
class TileClasses {
public:
    explicit TileClasses(Size video);

    /// Skipped work, see SkipOptions.
    struct Skips {
        bool upscaledTiles, plainTiles;
    };
    /// `weighed` and `trust` without data: there is no still.
    TileSummary classify(const TileWork& work, Rows<const WeighedCell> weighed,
                         Rows<const TrustCell> trust, Skips skips, Workers& workers);

    [[nodiscard]] const std::vector<TileClass>& classes() const { return classes_; }
    [[nodiscard]] TileClass at(int column, int row) const {
        return classes_[static_cast<std::size_t>(row) * tiles_.width + column];
    }

private:
    struct Fields;
    void classifyRow(const TileWork& work, const Fields& fields, int row);

    Size tiles_;
    std::vector<TileClass> classes_;
    std::vector<int> unexplained_;      // cells, per tile
    std::vector<TileSummary> rowSums_;  // per row of tiles
};

}  // namespace mfar::simd
