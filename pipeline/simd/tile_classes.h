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

/// Statistics of a frame's tiles, computed as in superres_classify.comp.
struct TileSummary {
    std::array<int, kTileClasses> tiles{};  ///< number of tiles of each class
    /// Number of tiles in which at least params::kUnexplainedCells cells match neither still.
    int unexplained = 0;
    int second = 0;  ///< number of drawn tiles for which TileClasses::showsSecond() is true
    /// Sum of one value per tile: 256 times the mean confidence (eq. 2 of the paper) of the tile's
    /// cells, rounded down. 0 if there is no still.
    double confidence = 0;
};

/// Determines the TileClass of every tile of a frame. For tiles that are not drawn again, it keeps
/// the number of cells that match neither still.
class TileClasses {
public:
    explicit TileClasses(Size video);

    /// See SkipOptions.
    struct Skips {
        bool enlargedTiles, plainTiles;
    };
    /// Results of WeighStep for one still. If there is no still, the fields have no data.
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

    /// True if the tile is matched, and the still's detail has a weight of at least one in every
    /// cell in and next to the tile. Learned filters would then add nothing, see detailRow().
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
