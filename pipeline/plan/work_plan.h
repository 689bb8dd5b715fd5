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
/// A tile is left alone where its difference to what was drawn is noise: where it passes tests of
/// its own, and where all such tiles, and those of each block of 8x8, together show no more than
/// the noise that their pixels have. The accumulated error of the picture stays below some 3 % of
/// the noise's variance on the mean, however slowly the scene changes; at rest nothing is drawn.
class WorkPlan {
public:
    /// `workers` share the comparison.
    explicit WorkPlan(Size video, std::shared_ptr<Workers> workers = nullptr);

    /// Compares `now` with `drawn` (both video size). `force` counts every tile as changed.
    void update(const RgbPlanes& now, const RgbPlanes& drawn, bool force);
    /// When what was drawn over tiles of the output has to be drawn anew.
    enum class Redraw : std::uint8_t {
        WithThem,    ///< one of the tiles has changed, or one beside them
        WithOthers,  ///< any tile has
        Always,      ///< whatever has
    };
    /// Something was drawn over these tiles of the output after they were drawn: at the next
    /// update() all of them count as changed when that is to be drawn anew; after it WithThem
    /// holds.
    void drawnOver(const PixelRect& tiles, Redraw redraw);
    /// The whole frame is drawn at once when so many tiles changed, [0, 1] of all; 0: when any did.
    void drawWholeFrom(double share) { wholeShare_ = share; }
    /// Matches tiles with the still where they have structure that noise does not explain, and
    /// those beside them, but at most this share of all, (0, 1]: those with the most structure.
    /// The others are for enlarging alone. At first, and with everything, all are matched.
    void matchStructured(double mostShare) { matchedShare_ = mostShare; }
    void matchEverything() { matchedShare_ = 0; }
    /// What the last update() found.
    [[nodiscard]] const TileWork& work() const { return work_; }
    /// Is what was drawn over tiles to be drawn anew, as of the last update()?
    [[nodiscard]] bool redraws() const { return redraws_; }
    [[nodiscard]] const std::vector<TileMeasure>& measured() const { return measured_; }
    [[nodiscard]] Size tileCount() const { return work_.tiles; }
    /// Standard deviation of the video's noise [grey levels], from the quietest tiles of the frames
    /// before. Before the first: that of 8-bit rounding.
    [[nodiscard]] double noise() const { return noise_; }
    /// Variance of the noise in means of 2x2 pixels, in quarters of a pixel's: 1 where it is white,
    /// more where a sensor's processing has smoothed it. From the difference of tiles that surely
    /// did not change, of the frames before.
    [[nodiscard]] double grain() const { return grain_; }

private:
    /// Where nothing is drawn by tiles, detail is not, either.
    [[nodiscard]] bool mayList() const { return matchedShare_ > 0 && wholeShare_ > 0; }
    void chooseMatched();
    /// Of what update() has measured, says which tiles changed.
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
