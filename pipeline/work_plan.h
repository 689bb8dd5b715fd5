#pragma once

#include "pipeline/geometry.h"
#include "pipeline/gpu/pass.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mfar {

/// The tiles that video pixels lie in.
[[nodiscard]] PixelRect tilesAround(const PixelRect& videoPixels);

/// Decides on the GPU what a frame has to compute: compares the video with what was last drawn,
/// tile by tile, and opens or shuts the frame's dispatches. A frame without any changed tile costs
/// one comparison; the CPU never waits to know.
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

    explicit WorkPlan(Size video);

    /// What a dispatch is for.
    enum class For : std::uint8_t {
        Changed,  ///< tiles that changed
        Matched,  ///< those of them that are matched with the still
    };
    /// Registers a dispatch. Before the first update() only.
    [[nodiscard]] Dispatch add(gpu::Groups groups, For what = For::Matched);

    /// Compares `now` with `drawn` (RGBA8, video size). `force` counts every tile as changed.
    void update(const gpu::Texture& now, const gpu::Texture& drawn, bool force);
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
        pass.runIndirect(params, bindings, plan_, kPlanHeader + 16u * dispatch.index);
    }

    /// uvec2 header: whole frame drawn at once (0: no, 1: yes, 2: all enlarged, and a list of tiles
    /// gets detail), changed tiles; then uvec2 per tile, row-major: changed, matched.
    [[nodiscard]] const gpu::Buffer& tiles() const { return tiles_; }
    /// The command of the full-screen draws: one instance when so much changed that drawing
    /// everything beats drawing tiles, none otherwise.
    [[nodiscard]] gpu::IndirectDraw wholeDraw() const { return {plan_, 16}; }
    /// The same for what adds detail, and for what enlarges alone: one of both at most.
    [[nodiscard]] gpu::IndirectDraw wholeDetailDraw() const { return {plan_, 48}; }
    [[nodiscard]] gpu::IndirectDraw wholeEnlargedDraw() const { return {plan_, 64}; }
    /// Number of tiles that the last update() found changed. Waits for the GPU.
    [[nodiscard]] int changedTiles() const;
    /// Number of those that are matched with the still. Waits for the GPU.
    [[nodiscard]] int matchedTiles() const;
    /// Is what was drawn over tiles to be drawn anew, as of the last update()? Waits for the GPU.
    [[nodiscard]] bool redraws() const;
    /// What plan_change.comp tells of each tile, two vec4, and whether it changed in the first.
    [[nodiscard]] const gpu::Buffer& measured() const { return measuredTiles_; }
    [[nodiscard]] Size tileCount() const { return tileCount_; }
    /// Standard deviation of the video's noise [grey levels], from the quietest tiles; follows
    /// update() a frame late, so that nothing waits. Before that: that of 8-bit rounding.
    [[nodiscard]] double noise() const { return noise_; }
    /// Variance of the noise in means of 2x2 pixels, in quarters of a pixel's: 1 where it is white,
    /// more where a sensor's processing has smoothed it. From the difference of tiles that surely
    /// did not change; likewise late.
    [[nodiscard]] double grain() const { return grain_; }

private:
    static constexpr std::size_t kPlanHeader = 80;  // summary, draws, grain

    void upload();
    /// Takes over what the last frame's plan says of the noise.
    void followNoise();

    struct ChangeParams {
        std::int32_t size[4];
        float threshold[4];
    };
    struct DispatchParams {
        std::int32_t counts[4], drawnOver[4], redraw[4];
        float noise[4];
        std::int32_t matched[4];
    };
    [[nodiscard]] DispatchParams dispatchParams(bool force);

    Size video_;
    Size tileCount_;
    double noise_, grain_ = 1, wholeShare_, matchedShare_ = 0;
    PixelRect drawnOver_;  // tiles
    Redraw redraw_ = Redraw::WithThem;
    bool measured_ = false;  // plan_ holds the summary of an earlier frame
    std::vector<std::array<std::uint32_t, 4>> wanted_;
    gpu::Buffer tiles_, measuredTiles_, wantedBuffer_, plan_;
    gpu::ComputePass<ChangeParams> change_;
    gpu::ComputePass<DispatchParams> dispatch_;
};

}  // namespace mfar
