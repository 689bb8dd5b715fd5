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
    /// The newest still counts as not showing a tile if the mean of (1 - weight) *
    /// TrustCell::signal over the tile's cells is at least this limit. In the synthetic office
    /// scene, a second still gained 0.14 dB with a limit of 0.2, 0.18 dB with 0.1 and 0.19 dB with
    /// 0.05. With 0.05, 1.5 times as many tiles are matched as with 0.1.
    static constexpr float kLack = 0.1F;
    /// Smallest gain in mean weight that is worth the time of matching with the second still.
    static constexpr float kGain = 0.05F;
    /// If a match with the second still gains less than kGain in a tile, choose() skips the tile
    /// the next kRest times that it would be a candidate.
    static constexpr int kRest = 8;

    struct Match {
        Rows<const WeighedCell> weighed;
        Rows<const TrustCell> trust;
    };

    explicit SecondTiles(Size tiles);

    /// Candidates are the tiles that are drawn and matched in this frame, but that the newest still
    /// does not show. Chooses at most `most` of them. Preferred are tiles of which the newest still
    /// shows little, tiles with much structure, and tiles that the second still showed before.
    /// `measured` must belong to the same frame. The result is valid until the next call.
    const TileWork& choose(const TileWork& work, std::span<const TileMeasure> measured,
                           const Match& newest, int most);
    /// Finds out in which of the chosen tiles the second still is better by at least kGain.
    /// `newest`, `second`: results of matching this frame with both stills.
    void judge(const Match& newest, Rows<const WeighedCell> second);
    /// Must be called when the second still or the newest still is replaced.
    void forget();

    /// Number of tiles that the frame of the last choose() draws and matches with the newest still.
    [[nodiscard]] int matched() const { return matched_; }
    [[nodiscard]] int shownByNewest() const { return shownByNewest_; }
    /// Number of chosen tiles that the second still improved, counted by the last judge().
    [[nodiscard]] int gained() const { return gained_; }

private:
    struct Candidate {
        float missing;
        int tile;
    };

    TileWork work_;
    std::vector<Candidate> candidates_;
    std::vector<bool> showed_;
    // For each tile: for how many more frames it is not matched with the second still, although it
    // would be a candidate.
    std::vector<std::uint8_t> rest_;
    int matched_ = 0, shownByNewest_ = 0, gained_ = 0;
};

}  // namespace mfar
