#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/enlarge.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/gles/tile_buffer.h"
#include "pipeline/gles/tile_pass.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Enlarges the video with learned filters, except for the final composite. It needs a current GL
/// context for its whole lifetime.
class LearnedEnlarger {
public:
    LearnedEnlarger(Size video, Size output);

    /// A still on the GPU and the look-ups into it.
    struct Seen {
        const gpu::Texture &still, &lookUps;
    };
    /// Computes the inputs of the composites in the tiles of `list`, or in all tiles if the plan
    /// requires it. `seen` may be null.
    void run(const gpu::Texture& video, const Seen* seen, const TileBuffer& tiles,
             const FilterBank& filters, params::DrawTiles params, const gpu::InstanceList& list);
    /// Replaces the composites' inputs by those of another still in the listed tiles and around
    /// them. The next run() computes the first still's inputs again.
    void seeSecond(const gpu::Texture& video, const Seen& seen, const FilterBank& filters,
                   params::DrawTiles params, const gpu::InstanceList& list);
    /// Must be called for a frame that other passes drew. The next run() then computes all tiles.
    void skip() { columnsAreOld_ = seenIsOld_ = guidedIsOld_ = true; }

    // Inputs of composites with LEARNED, for bindings 0, 3 and 4.
    [[nodiscard]] const gpu::Texture& columns() const { return columns_; }
    [[nodiscard]] const gpu::Texture& residuals() const { return residuals_; }
    [[nodiscard]] const gpu::Texture& tiles() const { return learned_; }
    [[nodiscard]] DetailPasses& passes() { return passes_; }
    /// Draws a second still over the first one. Binding 5 takes the first still's look-ups.
    [[nodiscard]] gpu::DrawPass<params::DrawTiles>& second() { return second_; }

private:
    void takeFilters(const FilterBank& filters);
    void takeTiles(const TileWork& work);
    void fillGrid(const gpu::Texture& video, const TileBuffer& tiles);

    Size video_, tiles_;
    std::uint64_t number_ = 0;                      // number of the filters on the GPU
    std::vector<std::uint8_t> mask_;                // flags of the tiles on the GPU
    bool columnsAreOld_ = true, seenIsOld_ = true;  // not computed in the last frame
    bool guidedIsOld_ = true;
    gpu::Texture filters_, learned_, grid_, seen_, guided_, columns_, residuals_;
    gpu::Framebuffer seenTarget_, guidedTarget_, columnsTarget_;
    gpu::ComputePass<params::EnlargeTiles> enlarge_;
    TilePass see_, guide_, enlargeColumns_;
    DetailPasses passes_;
    gpu::DrawPass<params::DrawTiles> seeAround_, guideAround_, enlargeColumnsAround_, second_;
};

}  // namespace mfar
