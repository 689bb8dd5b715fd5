#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/tile_measure.h"
#include "pipeline/plan/tile_work.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Chooses the tiles of a frame that are also matched with a second still. These tiles are outside
/// the newest still's view or occluded in the newest still.
class SecondTiles {
public:
    /// The newest still does not show a tile if the mean weight of the tile's cells is below 1 by
    /// this much. In the synthetic office scene, 0.2, 0.1 and 0.05 gained 0.14, 0.18 and 0.19 dB;
    /// 0.05 matches 1.5 times as many tiles as 0.1.
    static constexpr float kLack = 0.1F;
    /// Gain in mean weight from which on matching a tile with the second still is worth its time.
    static constexpr float kGain = 0.05F;
    /// If the second still does not show a tile either, the tile is not tried again for this number
    /// of frames.
    static constexpr int kRest = 8;

    /// How the newest still matches the frame, for each cell.
    struct Match {
        Rows<const WeighedCell> weighed;
        Rows<const TrustCell> trust;
    };

    explicit SecondTiles(Size tiles);

    /// Chooses at most `most` tiles that the frame draws and matches but the newest still does not
    /// show. Tiles that lack the most structure come first, and tiles that the second still showed
    /// before are preferred. `measured` must belong to the same frame. The result is valid until
    /// the next call.
    const TileWork& choose(const TileWork& work, std::span<const TileMeasure> measured,
                           const Match& newest, int most);
    /// Records which of the chosen tiles the second still shows.
    void judge(const Match& newest, Rows<const WeighedCell> second);
    /// Must be called when the second or the newest still changes.
    void forget();

    /// Number of tiles that the frame of the last choose() matches.
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
    std::vector<bool> showed_;        // second still showed the tile at its last match
    std::vector<std::uint8_t> rest_;  // frames in which the tile is not tried
    int matched_ = 0, shownByNewest_ = 0, gained_ = 0;
};

}  // namespace mfar
