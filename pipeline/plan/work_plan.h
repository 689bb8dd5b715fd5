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

[[nodiscard]] PixelRect tilesAround(const PixelRect& videoPixels);

/// Decides what a frame has to compute. On the CPU, it compares each tile of the video with the
/// video from which the tile was last drawn. For a frame without any changed tile, this comparison
/// is almost the only work.
///
/// A tile is drawn again when noise does not explain its difference. In addition, the differences
/// are summed over the unchanged tiles of each block of 8x8 tiles, and of the whole picture. If a
/// sum exceeds what noise explains, the whole block or picture is drawn again. However slowly the
/// scene changes, the accumulated mean squared error stays below 3 % of the noise's variance. While
/// nothing moves, nothing is drawn.
class WorkPlan {
public:
    /// `workers` are the threads that compare the tiles. If it is null, the caller's thread
    /// compares them.
    explicit WorkPlan(Size video, std::shared_ptr<Workers> workers = nullptr);

    /// Compares `now` with `drawn`, both of the video's size. If `force` is true, every tile is
    /// drawn again.
    void update(const RgbPlanes& now, const RgbPlanes& drawn, bool force);
    /// Changes of the video that make it necessary to draw an overlay (the virtual objects) again.
    /// WithThem: a change of one of the overlay's tiles or of an adjacent tile. WithOthers: a
    /// change of any tile. Always: the overlay is drawn again even if no tile changed.
    enum class Redraw : std::uint8_t {
        WithThem,
        WithOthers,
        Always,
    };
    /// Must be called after an overlay was drawn over these tiles of the output picture. `redraw`
    /// determines after which changes the overlay must be drawn again, and applies to the next
    /// update() only. If that update() finds such a change, all of these tiles are drawn again.
    /// Without a new call, WithThem applies.
    void drawnOver(const PixelRect& tiles, Redraw redraw);
    /// Sets the smallest share of changed tiles, [0, 1], for which the whole frame is drawn at
    /// once. With 0, any changed tile is enough.
    void drawWholeFrom(double share) { wholeShare_ = share; }
    /// From now on, only tiles with structure above the noise, and the neighbours of such tiles,
    /// are matched with the still. All other tiles are only enlarged. `mostShare`, (0, 1], limits
    /// the share of matched tiles; tiles with the most structure are preferred. By default, all
    /// tiles are matched.
    void matchStructured(double mostShare) { matchedShare_ = mostShare; }
    void matchEverything() { matchedShare_ = 0; }
    [[nodiscard]] const TileWork& work() const { return work_; }
    [[nodiscard]] bool redraws() const { return redraws_; }
    /// Returns the share of tiles whose video changed since they were last drawn, [0, 1].
    [[nodiscard]] double changedShare() const { return changedShare_; }
    /// Returns the share of tiles that are drawn again for any reason, [0, 1].
    [[nodiscard]] double redrawnShare() const;
    /// Returns the number of tiles with structure, divided by the number of those that are matched.
    /// It is above 1 only if matchStructured() limits the share of matched tiles. Returns 1 if no
    /// tile is matched.
    [[nodiscard]] double structuredPerMatched() const;
    [[nodiscard]] const std::vector<TileMeasure>& measured() const { return measured_; }
    /// Smallest TileMeasure::structure that is above the noise.
    [[nodiscard]] double leastStructure() const;
    [[nodiscard]] Size tileCount() const { return work_.tiles; }
    /// Standard deviation of the video's noise [grey levels], measured in the quietest tiles of
    /// earlier frames. Before the first frame it is the standard deviation of 8-bit rounding.
    [[nodiscard]] double noise() const { return noise_; }
    /// Variance of the noise in the means of 2x2 pixels, divided by a quarter of the variance in
    /// single pixels. It is 1 for white noise, and larger if the sensor has smoothed the noise. It
    /// is measured in unchanged tiles of earlier frames.
    [[nodiscard]] double grain() const { return grain_; }

private:
    [[nodiscard]] bool mayList() const { return matchedShare_ > 0 && wholeShare_ > 0; }
    void chooseMatched();
    void chooseChanged(Redraw redraw, bool force);
    [[nodiscard]] double quietestDecile() const;
    void followNoise(const TileEnergy& unchanged);

    std::shared_ptr<Workers> workers_;
    double noise_, grain_ = 1, wholeShare_, matchedShare_ = 0;
    PixelRect drawnOver_;
    Redraw redraw_ = Redraw::WithThem;
    std::vector<TileMeasure> measured_;
    StructuredTiles structured_;
    bool redraws_ = false;
    double changedShare_ = 0;
    TileWork work_;
};

}  // namespace mfar
