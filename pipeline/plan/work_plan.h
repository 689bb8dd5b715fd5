#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "base/workers.h"
#include "pipeline/plan/tile_choice.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// The tiles that video pixels lie in.
[[nodiscard]] PixelRect tilesAround(const PixelRect& videoPixels);

/// Decides what a frame has to compute: compares the video with what was last drawn, tile by tile,
/// and opens or shuts the frame's dispatches. A frame without any changed tile costs one
/// comparison, on the host, where the video lies: nothing waits for the GPU, and what is shut is
/// not even called.
///
/// A tile is left alone where its difference to what was drawn is noise: where it passes tests of
/// its own, and where all such tiles, and those of each block of 8x8, together show no more than
/// the noise that their pixels have. What the picture is off by stays below some 3 % of the noise's
/// variance on the mean, however slowly it came; at rest nothing is drawn.
class WorkPlan {
public:
    /// Handle of a dispatch whose group counts the plan controls.
    struct Dispatch {
        int index;
    };

    /// `workers` share the comparison.
    explicit WorkPlan(Size video, std::shared_ptr<Workers> workers = nullptr);

    /// What a dispatch is for.
    enum class For : std::uint8_t {
        Changed,  ///< tiles that changed
        Matched,  ///< those of them that are matched with the still
    };
    /// Registers a dispatch.
    [[nodiscard]] Dispatch add(gpu::Groups groups, For what = For::Matched);

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
    /// Opens every dispatch without comparing anything.
    void openAll();

    /// Runs a registered dispatch if the frame needs it.
    template <class P>
    void run(gpu::ComputePass<P>& pass, const P& params, gpu::Bindings bindings,
             Dispatch dispatch) const {
        if (opens(dispatch)) pass.run(params, bindings, wantedOf(dispatch).groups);
    }
    [[nodiscard]] bool opens(Dispatch dispatch) const {
        return opensAll_ || (wantedOf(dispatch).what == For::Matched ? matched_ : changed_) > 0;
    }

    /// uvec2 header: whole frame drawn at once (0: no, 1: yes, 2: all enlarged, and a list of tiles
    /// gets detail), changed tiles; then uvec2 per tile, row-major: changed, matched.
    [[nodiscard]] const gpu::Buffer& tiles() const { return buffer_; }
    /// What the full-screen draws draw: everything, as so much changed that this beats drawing
    /// tiles; what adds detail and what enlarges alone: one of both at most.
    [[nodiscard]] bool drawsWhole() const { return whole_; }
    [[nodiscard]] bool drawsWholeDetail() const { return whole_ && !listsDetail_; }
    [[nodiscard]] bool drawsWholeEnlarged() const { return whole_ && listsDetail_; }
    /// The tiles of a whole frame that detail is drawn in: the least rectangle with all in it that
    /// are matched. Around it all is enlarged.
    [[nodiscard]] const PixelRect& detailTiles() const { return detailTiles_; }
    /// Number of tiles that the last update() found changed.
    [[nodiscard]] int changedTiles() const { return changed_; }
    /// Number of those that are matched with the still.
    [[nodiscard]] int matchedTiles() const { return matched_; }
    /// Is what was drawn over tiles to be drawn anew, as of the last update()?
    [[nodiscard]] bool redraws() const { return redraws_; }
    [[nodiscard]] const std::vector<TileMeasure>& measured() const { return measured_; }
    /// After the last update() a tile is drawn, as it changed or everything is.
    [[nodiscard]] bool draws(std::size_t tile) const {
        return whole_ || plan_[kHeader + tile][0] != 0;
    }
    [[nodiscard]] Size tileCount() const { return tileCount_; }
    /// Standard deviation of the video's noise [grey levels], from the quietest tiles of the frames
    /// before. Before the first: that of 8-bit rounding.
    [[nodiscard]] double noise() const { return noise_; }
    /// Variance of the noise in means of 2x2 pixels, in quarters of a pixel's: 1 where it is white,
    /// more where a sensor's processing has smoothed it. From the difference of tiles that surely
    /// did not change, of the frames before.
    [[nodiscard]] double grain() const { return grain_; }

private:
    struct Wanted {
        gpu::Groups groups;
        For what;
    };
    static constexpr std::size_t kHeader = 1;  // entries of plan_ before the tiles

    [[nodiscard]] const Wanted& wantedOf(Dispatch dispatch) const {
        return wanted_[static_cast<std::size_t>(dispatch.index)];
    }
    /// Where nothing is drawn by tiles, detail is not, either.
    [[nodiscard]] bool mayList() const { return matchedShare_ > 0 && wholeShare_ > 0; }
    void chooseMatched();
    /// Of what update() has measured, says which tiles changed.
    void chooseChanged(Redraw redraw);
    void upload();
    [[nodiscard]] double quietestDecile() const;
    void followNoise(const TileEnergy& unchanged);

    Size tileCount_;
    std::shared_ptr<Workers> workers_;
    double noise_, grain_ = 1, wholeShare_, matchedShare_ = 0;
    PixelRect drawnOver_, detailTiles_;  // tiles
    Redraw redraw_ = Redraw::WithThem;
    std::vector<Wanted> wanted_;
    std::vector<TileMeasure> measured_;
    StructuredTiles structured_;
    int changed_ = 0, matched_ = 0;
    bool opensAll_ = false, whole_ = false, listsDetail_ = false, redraws_ = false;
    std::vector<std::array<std::uint32_t, 2>> plan_, uploaded_;  // header and tiles
    gpu::Buffer buffer_;
};

}  // namespace mfar
