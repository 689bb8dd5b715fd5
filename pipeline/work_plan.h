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
class WorkPlan {
public:
    /// Handle of a dispatch whose group counts the plan controls.
    struct Dispatch {
        int index;
    };

    explicit WorkPlan(Size video);

    /// Registers a dispatch. Before the first update() only.
    [[nodiscard]] Dispatch add(gpu::Groups groups);

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
    /// Opens every dispatch without comparing anything.
    void openAll();

    /// Runs a registered dispatch if the frame needs it.
    template <class P>
    void run(gpu::ComputePass<P>& pass, const P& params, gpu::Bindings bindings,
             Dispatch dispatch) const {
        pass.runIndirect(params, bindings, plan_, kPlanHeader + 16u * dispatch.index);
    }

    /// uvec2 header: whole frame drawn at once, changed tiles; then uvec2 per tile, row-major:
    /// changed, noise [1/256 grey level].
    [[nodiscard]] const gpu::Buffer& tiles() const { return tiles_; }
    /// The command of the full-screen draws: one instance when so much changed that drawing
    /// everything beats drawing tiles, none otherwise.
    [[nodiscard]] gpu::IndirectDraw wholeDraw() const { return {plan_, 16}; }
    /// Number of tiles that the last update() found changed. Waits for the GPU.
    [[nodiscard]] int changedTiles() const;
    /// Is what was drawn over tiles to be drawn anew, as of the last update()? Waits for the GPU.
    [[nodiscard]] bool redraws() const;
    [[nodiscard]] Size tileCount() const { return tileCount_; }
    /// Standard deviation of the video's noise [grey levels], from the quietest tiles; follows
    /// update() a frame late, so that nothing waits. Before that: that of 8-bit rounding.
    [[nodiscard]] double noise() const { return noise_; }

private:
    static constexpr std::size_t kPlanHeader = 32;  // summary, whole draw

    void upload();

    struct ChangeParams {
        std::int32_t size[4];
        float threshold[4];
        std::int32_t force[4];
    };
    struct DispatchParams {
        std::int32_t counts[4], drawnOver[4], redraw[4];
    };

    Size video_;
    Size tileCount_;
    double noise_, wholeShare_;
    PixelRect drawnOver_;  // tiles
    Redraw redraw_ = Redraw::WithThem;
    bool measured_ = false;  // plan_ holds the summary of an earlier frame
    std::vector<std::array<std::uint32_t, 4>> wanted_;
    gpu::Buffer tiles_, wantedBuffer_, plan_;
    gpu::ComputePass<ChangeParams> change_;
    gpu::ComputePass<DispatchParams> dispatch_;
};

}  // namespace mfar
