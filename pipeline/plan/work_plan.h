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

/// Rectangle of the tiles that contain these video pixels.
[[nodiscard]] PixelRect tilesAround(const PixelRect& videoPixels);

/// Decides what a frame has to compute. It compares the video of each tile with the video from
/// which the tile was last drawn, on the CPU. A frame without any changed tile costs only this
/// comparison.
///
/// A tile is not drawn again as long as noise explains the difference. This is tested for each tile
/// on its own. In addition, the differences are summed over the unchanged tiles of each block of
/// 8x8 tiles and of the whole picture; the tiles are drawn again if a sum is larger than the noise
/// explains. The mean squared error that accumulates stays below 3 % of the noise's variance,
/// however slowly the scene changes. While nothing moves, nothing is drawn.
class WorkPlan {
public:
    /// `workers` run the comparison of the tiles. Null: it runs in the caller's thread.
    explicit WorkPlan(Size video, std::shared_ptr<Workers> workers = nullptr);

    /// Compares `now` with `drawn`, both of the video's size. If `force` is true, every tile counts
    /// as changed.
    void update(const RgbPlanes& now, const RgbPlanes& drawn, bool force);
    /// After which changes of the video an overlay (the virtual objects) must be drawn again.
    enum class Redraw : std::uint8_t {
        WithThem,    ///< after a change of one of the overlay's tiles or of an adjacent tile
        WithOthers,  ///< after a change of any tile
        Always,      ///< the overlay is drawn again even without a change
    };
    /// Reports that an overlay was drawn over these tiles of the output picture. If the next
    /// update() finds that the overlay must be drawn again, all of these tiles count as changed.
    /// update() resets `redraw` to WithThem.
    void drawnOver(const PixelRect& tiles, Redraw redraw);
    /// Sets the smallest share of changed tiles, [0, 1], for which the whole frame is drawn at
    /// once. 0: the whole frame is drawn if any tile changed.
    void drawWholeFrom(double share) { wholeShare_ = share; }
    /// From now on, only tiles with structure above the noise, and their neighbours, are matched
    /// with the still. Other tiles are only enlarged. `mostShare`: largest share of all tiles that
    /// are matched, (0, 1]; tiles with the most structure are preferred. By default all tiles are
    /// matched.
    void matchStructured(double mostShare) { matchedShare_ = mostShare; }
    void matchEverything() { matchedShare_ = 0; }
    /// Result of the last update().
    [[nodiscard]] const TileWork& work() const { return work_; }
    /// Whether the last update() found that the overlay must be drawn again.
    [[nodiscard]] bool redraws() const { return redraws_; }
    [[nodiscard]] const std::vector<TileMeasure>& measured() const { return measured_; }
    [[nodiscard]] Size tileCount() const { return work_.tiles; }
    /// Standard deviation of the video's noise [grey levels], measured in the quietest tiles of
    /// earlier frames. Before the first frame it is that of 8-bit rounding.
    [[nodiscard]] double noise() const { return noise_; }
    /// Ratio of the noise variance of 2x2 means to a quarter of a pixel's noise variance. It is 1
    /// for white noise, and larger if the sensor's processing has smoothed the noise. It is
    /// measured from the differences in unchanged tiles of earlier frames.
    [[nodiscard]] double grain() const { return grain_; }

private:
    /// Whether detail may be drawn tile by tile. This is not the case if all tiles are matched or
    /// frames are always drawn at once.
    [[nodiscard]] bool mayList() const { return matchedShare_ > 0 && wholeShare_ > 0; }
    void chooseMatched();
    /// Decides which tiles changed, from the measurements of update().
    void chooseChanged(Redraw redraw);
    [[nodiscard]] double quietestDecile() const;
    void followNoise(const TileEnergy& unchanged);

    std::shared_ptr<Workers> workers_;
    double noise_, grain_ = 1, wholeShare_, matchedShare_ = 0;
    PixelRect drawnOver_;  // tiles that the overlay covers [tiles]
    Redraw redraw_ = Redraw::WithThem;
    std::vector<TileMeasure> measured_;
    StructuredTiles structured_;
    bool redraws_ = false;
    TileWork work_;
};

}  // namespace mfar
