#pragma once

#include "base/geometry.h"
#include "base/workers.h"
#include "pipeline/plan/tile_choice.h"
#include "pipeline/plan/tile_work.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// The tiles that video pixels lie in.
[[nodiscard]] PixelRect tilesAround(const PixelRect& videoPixels);

/// Decides what a frame has to compute: compares the video with what was last drawn, tile by tile,
/// on the host. A frame without any changed tile costs that comparison alone.
///
/// A tile is not drawn again as long as its difference to the drawn picture is noise: it passes
/// the tests of one tile, and the sums over all such tiles and each block of 8x8 tiles do not
/// exceed the pixels' noise. The mean accumulated error stays below 3 % of the noise's variance,
/// however slowly the scene changes; at rest nothing is drawn.
class WorkPlan {
public:
    /// The comparison runs on `workers`.
    explicit WorkPlan(Size video, std::shared_ptr<Workers> workers = nullptr);

    /// Compares `now` with `drawn` (both video size). `force` counts every tile as changed.
    void update(const RgbPlanes& now, const RgbPlanes& drawn, bool force);
    /// Which changes make it necessary to draw an overlay again.
    enum class Redraw : std::uint8_t {
        WithThem,    ///< if one of the tiles or a neighbour changed
        WithOthers,  ///< if any tile changed
        Always,      ///< even without a change
    };
    /// An overlay was drawn on these tiles of the output. If the next update() finds that it has
    /// to be drawn again, all of these tiles count as changed. update() resets to WithThem.
    void drawnOver(const PixelRect& tiles, Redraw redraw);
    /// Share of changed tiles, [0, 1], at or above which the whole frame is drawn at once; 0: if
    /// any tile changed.
    void drawWholeFrom(double share) { wholeShare_ = share; }
    /// Tiles with structure above the noise, and their neighbours, are matched with the still, but
    /// at most this share of all tiles, (0, 1]: those with the most structure. The others are only
    /// enlarged. The default matches all.
    void matchStructured(double mostShare) { matchedShare_ = mostShare; }
    void matchEverything() { matchedShare_ = 0; }
    /// Result of the last update().
    [[nodiscard]] const TileWork& work() const { return work_; }
    /// Did the last update() find that the overlay has to be drawn again?
    [[nodiscard]] bool redraws() const { return redraws_; }
    [[nodiscard]] const std::vector<TileMeasure>& measured() const { return measured_; }
    [[nodiscard]] Size tileCount() const { return work_.tiles; }
    /// Standard deviation of the video's noise [grey levels], from the quietest tiles of earlier
    /// frames; that of 8-bit rounding before the first frame.
    [[nodiscard]] double noise() const { return noise_; }
    /// Noise variance of 2x2 means, relative to a quarter of a pixel's: 1 for white noise, more
    /// where a sensor's processing has smoothed it. From the differences of unchanged tiles of
    /// earlier frames.
    [[nodiscard]] double grain() const { return grain_; }

private:
    /// If frames are always drawn whole, so is detail.
    [[nodiscard]] bool mayList() const { return matchedShare_ > 0 && wholeShare_ > 0; }
    void chooseMatched();
    /// Decides from the measurements of update() which tiles changed.
    void chooseChanged(Redraw redraw);
    [[nodiscard]] double quietestDecile() const;
    void followNoise(const TileEnergy& unchanged);

    std::shared_ptr<Workers> workers_;
    double noise_, grain_ = 1, wholeShare_, matchedShare_ = 0;
    PixelRect drawnOver_;  // tiles
    Redraw redraw_ = Redraw::WithThem;
    std::vector<TileMeasure> measured_;
    StructuredTiles structured_;
    bool redraws_ = false;
    TileWork work_;
};

}  // namespace mfar
