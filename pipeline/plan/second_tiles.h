#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/tile_measure.h"
#include "pipeline/plan/tile_work.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Chooses the tiles of a frame that are matched with a second still, too: those that the newest
/// does not show, as it lies outside of its view or is hidden there.
class SecondTiles {
public:
    /// A still does not show a tile whose cells lack so much weight in the mean. On the synthetic
    /// office 0.2, 0.1 and 0.05 gained 0.14, 0.18 and 0.19 dB in the mean of its frames; from 0.1
    /// to 0.05 half as many tiles more are matched for that.
    static constexpr float kLack = 0.1F;
    /// What a second still must add to their weight to be worth its time.
    static constexpr float kGain = 0.05F;
    /// Frames that a tile is left alone in when the second still did not show it either.
    static constexpr int kRest = 8;

    /// How the newest still matches, cell by cell.
    struct Match {
        Rows<const WeighedCell> weighed;
        Rows<const TrustCell> trust;
    };

    explicit SecondTiles(Size tiles);

    /// Of the tiles that a frame draws and matches, those that the newest still does not show: at
    /// most `most` of them, first those that miss the most structure, rather those that the second
    /// still showed before. `measured`: of the same frame. Valid until the next call.
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
