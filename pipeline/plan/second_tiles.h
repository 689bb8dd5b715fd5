#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/tile_measure.h"
#include "pipeline/plan/tile_work.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Chooses the tiles of a frame that are also matched with a second still: those that lie outside
/// the newest still's view or are occluded in it.
class SecondTiles {
public:
    /// A still does not show a tile whose cells' mean weight is below 1 by this much. On the
    /// synthetic office, 0.2, 0.1 and 0.05 gained 0.14, 0.18 and 0.19 dB; 0.05 matches half as many
    /// tiles again as 0.1.
    static constexpr float kLack = 0.1F;
    /// Mean weight that a second still has to add to be worth its time.
    static constexpr float kGain = 0.05F;
    /// For this many frames a tile is not tried again that the second still does not show either.
    static constexpr int kRest = 8;

    /// How the newest still matches, cell by cell.
    struct Match {
        Rows<const WeighedCell> weighed;
        Rows<const TrustCell> trust;
    };

    explicit SecondTiles(Size tiles);

    /// The tiles that the frame draws and matches and that the newest still does not show, at most
    /// `most`: those that lack the most structure first, and those that the second still showed
    /// before preferred. `measured`: of the same frame. Valid until the next call.
    const TileWork& choose(const TileWork& work, std::span<const TileMeasure> measured,
                           const Match& newest, int most);
    /// Remembers which of the chosen tiles the second still shows.
    void judge(const Match& newest, Rows<const WeighedCell> second);
    /// Another second still, or another newest.
    void forget();

    /// Tiles that are matched in the frame of the last choose().
    [[nodiscard]] int matched() const { return matched_; }
    /// Those of them that the newest still shows.
    [[nodiscard]] int shownByNewest() const { return shownByNewest_; }
    /// Of the chosen tiles, as of the last judge().
    [[nodiscard]] int gained() const { return gained_; }

private:
    struct Candidate {
        float missing;
        int tile;
    };

    TileWork work_;
    std::vector<Candidate> candidates_;
    std::vector<bool> showed_;        // the second still did, when it was matched last
    std::vector<std::uint8_t> rest_;  // frames
    int matched_ = 0, shownByNewest_ = 0, gained_ = 0;
};

}  // namespace mfar
