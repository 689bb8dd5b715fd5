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
    /// A tile that the second still does not show either is not tried again for this many frames.
    static constexpr int kRest = 8;

    /// How the newest still matches, cell by cell.
    struct Match {
        Rows<const WeighedCell> weighed;
        Rows<const TrustCell> trust;
    };

    explicit SecondTiles(Size tiles);

    /// Chooses at most `most` tiles that the frame draws and matches and that the newest still does
    /// not show. Tiles that lack the most structure come first; tiles that the second still showed
    /// before are preferred. `measured`: of the same frame. Valid until the next call.
    const TileWork& choose(const TileWork& work, std::span<const TileMeasure> measured,
                           const Match& newest, int most);
    /// Remembers which of the chosen tiles the second still shows.
    void judge(const Match& newest, Rows<const WeighedCell> second);
    /// To be called when the second or the newest still changes.
    void forget();

    /// Number of tiles that are matched in the frame of the last choose().
    [[nodiscard]] int matched() const { return matched_; }
    /// Number of the matched tiles that the newest still shows.
    [[nodiscard]] int shownByNewest() const { return shownByNewest_; }
    /// Number of chosen tiles that the second still improved, found by the last judge().
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
