#pragma once

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_lists.h"

#include <array>
#include <span>
#include <vector>

namespace mfar {

/// Dense flow between video and still, in both directions, without knowledge of the pose:
/// coarse-to-fine inverse search with a gain-invariant cost on 8x8 patches every 4 pixels,
/// propagation, Gauss-Newton refinement, robust clean-up.
/// Sources: Kroeger et al., ECCV 2016 (inverse search); Barnes et al., 2009 (propagation).
class Flow2d {
public:
    /// A field of flow vectors, one per cell of 4x4 video pixels, in patches().
    struct Field {
        int offset = 0;  ///< first vec4 (flow x, y [px of its level], cost, texture)
        Size cells;      ///< columns, rows
        int level = 0;   ///< level of the pyramid
    };

    /// Throws std::invalid_argument for options out of range.
    explicit Flow2d(Size video, const Flow2dOptions& options = {});

    /// See changed() in flow_options.h; takes effect with the next run. Throws
    /// std::invalid_argument for options out of range.
    void setOptions(const Flow2dOptions& options) { options_ = changed(options_, options); }

    /// Computes both fields; does nothing if no tile is matched. `usePrior`: the last frame's field
    /// is a candidate everywhere (not after a new still).
    void run(const LumaOnGpu& luma, const TileBuffer& tiles, bool usePrior);

    /// Computes the forward field from one vector per cell whose error is a fraction of a pixel;
    /// `errors`: the known two-way error of eq. 2, in x [px]. Tiles that their vectors do not
    /// explain are searched in 2-D from coarse to fine.
    using Cells = std::span<const std::array<float, 4>>;
    void refine(const LumaOnGpu& luma, const TileBuffer& tiles, Cells forward, Cells errors);

    /// The tiles that the last refine() searched.
    [[nodiscard]] const TileLists& searched() const { return searched_; }

    [[nodiscard]] const gpu::Buffer& patches() const { return patches_; }
    [[nodiscard]] const Field& forward() const { return forward_; }  ///< video -> still
    /// The forward vectors, x, y [px], -, -. Waits for the GPU.
    [[nodiscard]] std::vector<std::array<float, 4>> readForward() const {
        return patches_.read<std::array<float, 4>>(static_cast<std::size_t>(forward_.cells.width) *
                                                       forward_.cells.height,
                                                   16UL * forward_.offset);
    }
    /// True after refine(): backward() then holds the two-way errors of the video's cells.
    [[nodiscard]] bool errorsGiven() const { return errorsGiven_; }
    [[nodiscard]] const Field& backward() const { return backward_; }  ///< still -> video

private:
    /// One level of one direction: two areas, because propagation cannot work in place.
    struct Stage {
        Size cells;
        int area[2];
        gpu::Groups groups;
    };
    /// A pass through the levels, from coarse to fine.
    struct Direction {
        const std::vector<LumaLevel>& from;  ///< source of the patches
        const std::vector<LumaLevel>& to;    ///< searched picture
        const std::vector<Stage>& stages;
        int finest;  // last level
        int finestPropagations;
        bool usePrior;
    };

    void run(const Direction& way, const LumaOnGpu& luma);
    void search(const Direction& way, int level, int area, const LumaOnGpu& luma);
    void searchListed(const LumaOnGpu& luma);
    [[nodiscard]] params::SearchFlow searchParams(const Direction& way, int level, int area,
                                                  int radius, int prior) const;
    void propagate(const Direction& way, int level, int toArea, const LumaOnGpu& luma);
    /// Refines the vectors from `in` on by Gauss-Newton steps.
    void align(int in, const LumaOnGpu& luma, const TileBuffer& tiles);
    void filter(const Stage& stage, const Field& out, const TileBuffer& tiles);

    Flow2dOptions options_;
    std::vector<Stage> forwardStages_, backwardStages_;
    Field forward_, backward_;
    bool errorsGiven_ = false;
    int seed_;  // first vec4 of refine()'s forward vectors
    gpu::Buffer patches_;
    TileLists searched_;
    gpu::ComputePass<params::SearchFlow> search_, searchListed_;
    gpu::ComputePass<params::RefineFlow> propagate_, align_;
    gpu::ComputePass<params::FilterFlow> filter_;
};

}  // namespace mfar
