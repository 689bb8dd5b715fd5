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
/// its own tests, and the sums over all such tiles and over each block of 8x8 tiles do not exceed
/// the pixels' noise. The mean accumulated error stays below 3 % of the noise's variance, however
/// slowly the scene changes; at rest nothing is drawn.
class WorkPlan {
public:
    /// `workers` share the comparison.
    explicit WorkPlan(Size video, std::shared_ptr<Workers> workers = nullptr);

    /// Compares `now` with `drawn` (both video size). `force` counts every tile as changed.
    void update(const RgbPlanes& now, const RgbPlanes& drawn, bool force);
    /// When an overlay has to be drawn again.
    enum class Redraw : std::uint8_t {
        WithThem,    ///< one of the tiles has changed, or one beside them
        WithOthers,  ///< any tile has
        Always,      ///< whatever has
    };
    /// An overlay was drawn on these tiles of the output. If the next update() finds that it has
    /// to be drawn again, all of these tiles count as changed. update() resets to WithThem.
    void drawnOver(const PixelRect& tiles, Redraw redraw);
    /// The whole frame is drawn at once from this share of changed tiles on, [0, 1]; 0: if any did.
    void drawWholeFrom(double share) { wholeShare_ = share; }
    /// Tiles with structure above the noise, and their neighbours, are matched with the still, but
    /// at most this share of all tiles, (0, 1]: those with the most structure. The others are only
    /// enlarged. The default matches all.
    void matchStructured(double mostShare) { matchedShare_ = mostShare; }
    void matchEverything() { matchedShare_ = 0; }
    /// What the last update() found.
    [[nodiscard]] const TileWork& work() const { return work_; }
    /// Does the overlay have to be drawn again, as of the last update()?
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
    /// If nothing is drawn by tiles, detail is not either.
    [[nodiscard]] bool mayList() const { return matchedShare_ > 0 && wholeShare_ > 0; }
    void chooseMatched();
    /// Decides from what update() measured which tiles changed.
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
