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

/// Counts of a frame, as superres_classify.comp makes them.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< count per TileClass
    int unexplained = 0;                    ///< tiles that no still shows
    int second = 0;                         ///< tiles that show the second still
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
    /// How a still matches; without data: there is none.
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

    /// Does some of the second still count for more than the first?
    [[nodiscard]] bool showsSecond(int column, int row) const {
        return second_[static_cast<std::size_t>(row) * tiles_.width + column] != 0;
    }

private:
    struct Fields;
    void classifyRow(const TileWork& work, const Fields& fields, int row);

    Size tiles_;
    std::vector<TileClass> classes_;
    std::vector<int> unexplained_;      // cells, per tile
    std::vector<std::uint8_t> second_;  // flags, per tile
    std::vector<TileSummary> rowSums_;  // per row of tiles
};

}  // namespace mfar::simd
