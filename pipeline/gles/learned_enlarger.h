#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/enlarge.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/gles/tile_buffer.h"
#include "pipeline/gles/tile_pass.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Enlarges the video with learned filters, except along rows: this last step is a part of the
/// shaders composite_*.frag. The object needs a current GL context for its whole lifetime.
class LearnedEnlarger {
public:
    LearnedEnlarger(Size video, Size output);

    struct Seen {
        const gpu::Texture &still, &lookUps;
    };
    /// Computes the inputs of composite_*.frag in the tiles of `list`. Computes them in all tiles
    /// if the whole frame is drawn or the last inputs are out of date. `seen` is null if there is
    /// no still.
    void run(const gpu::Texture& video, const Seen* seen, const TileBuffer& tiles,
             const FilterBank& filters, params::DrawTiles params, const gpu::InstanceList& list);
    /// Computes the inputs of composite_*.frag for a second still, in and around the tiles of
    /// `list`. The next run() computes them for the first still again.
    void seeSecond(const gpu::Texture& video, const Seen& seen, const FilterBank& filters,
                   params::DrawTiles params, const gpu::InstanceList& list);
    /// Must be called for a frame that is drawn without learned filters. The next run() then
    /// computes all tiles.
    void skip() { columnsAreOld_ = seenIsOld_ = guidedIsOld_ = true; }

    // Inputs of the LEARNED variants of composite_*.frag, for bindings 0, 3 and 4.
    [[nodiscard]] const gpu::Texture& columns() const { return columns_; }
    [[nodiscard]] const gpu::Texture& residuals() const { return residuals_; }
    [[nodiscard]] const gpu::Texture& tiles() const { return learned_; }
    [[nodiscard]] DetailPasses& passes() { return passes_; }
    /// The pass that draws a second still over the first one. The caller must bind the look-ups of
    /// the first still at binding 5.
    [[nodiscard]] gpu::DrawPass<params::DrawTiles>& second() { return second_; }

private:
    void takeFilters(const FilterBank& filters);
    void takeTiles(const TileWork& work);
    void fillGrid(const gpu::Texture& video, const TileBuffer& tiles);

    Size video_, tiles_;
    std::uint64_t number_ = 0;
    std::vector<std::uint8_t> mask_;
    // Each flag is true if its texture (columns_, seen_ or guided_) was not computed in the last
    // frame.
    bool columnsAreOld_ = true, seenIsOld_ = true;
    bool guidedIsOld_ = true;
    gpu::Texture filters_, learned_, grid_, seen_, guided_, columns_, residuals_;
    gpu::Framebuffer seenTarget_, guidedTarget_, columnsTarget_;
    gpu::ComputePass<params::EnlargeTiles> enlarge_;
    TilePass see_, guide_, enlargeColumns_;
    DetailPasses passes_;
    gpu::DrawPass<params::DrawTiles> seeAround_, guideAround_, enlargeColumnsAround_, second_;
};

}  // namespace mfar
