#pragma once

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_lists.h"

#include <array>
#include <span>
#include <vector>

namespace mfar {

/// Dense flow between video and still in both directions, computed without the pose. The steps are
/// a coarse-to-fine inverse search with a gain-invariant cost on 8x8 patches every 4 pixels,
/// propagation, Gauss-Newton refinement, and a robust clean-up.
/// Sources: Kroeger et al., ECCV 2016 (inverse search); Barnes et al., 2009 (propagation).
class Flow2d {
public:
    /// A field of flow vectors in cells(), with one vector per cell of 4x4 pixels.
    struct Field {
        int offset = 0;  ///< index of the first vec4 (flow x, y [px of the level], cost, texture)
        Size cells;      ///< columns, rows
        int level = 0;   ///< pyramid level
    };

    /// Throws std::invalid_argument if an option is out of range.
    explicit Flow2d(Size video, const Flow2dOptions& options = {});

    /// Takes effect with the next run; see changed() in flow_options.h. Throws
    /// std::invalid_argument if an option is out of range.
    void setOptions(const Flow2dOptions& options) { options_ = changed(options_, options); }

    /// Computes both fields. Does nothing if no tile is matched. If `usePrior` is true, the last
    /// frame's vectors are candidates in all cells; this is wrong after a new still.
    void run(const LumaOnGpu& luma, const TileBuffer& tiles, bool usePrior);

    /// Computes the forward field from one vector per cell whose error is less than a pixel.
    /// `errors` holds the known two-way error of each cell (eq. 2) in x [px]. Tiles whose vectors
    /// do not fit are searched in 2-D from coarse to fine.
    using Cells = std::span<const std::array<float, 4>>;
    void refine(const LumaOnGpu& luma, const TileBuffer& tiles, Cells forward, Cells errors);

    /// Lists of the tiles that the last refine() searched.
    [[nodiscard]] const TileLists& searched() const { return searched_; }

    [[nodiscard]] const gpu::Buffer& cells() const { return cells_; }
    [[nodiscard]] const Field& forward() const { return forward_; }  ///< from video to still
    /// The forward vectors: x, y [px], unused, unused. Waits for the GPU.
    [[nodiscard]] std::vector<std::array<float, 4>> readForward() const {
        return cells_.read<std::array<float, 4>>(static_cast<std::size_t>(forward_.cells.width) *
                                                     forward_.cells.height,
                                                 16UL * forward_.offset);
    }
    /// True after refine(). Then backward() holds the two-way errors of the video's cells.
    [[nodiscard]] bool errorsGiven() const { return errorsGiven_; }
    [[nodiscard]] const Field& backward() const { return backward_; }  ///< from still to video

private:
    /// The cells of one level in one direction. There are two areas, because propagation cannot
    /// work in place.
    struct Stage {
        Size cells;
        int area[2];
        gpu::Groups groups;
    };
    /// Input of a pass through the levels, from coarse to fine.
    struct Direction {
        const std::vector<LumaLevel>& from;  ///< picture that the patches are taken from
        const std::vector<LumaLevel>& to;    ///< picture in which the patches are searched
        const std::vector<Stage>& stages;
        int finest;  // the last level
        int finestPropagations;
        bool usePrior;
    };

    void run(const Direction& way, const LumaOnGpu& luma);
    void search(const Direction& way, int level, int area, const LumaOnGpu& luma);
    void searchListed(const LumaOnGpu& luma);
    [[nodiscard]] params::SearchFlow searchParams(const Direction& way, int level, int area,
                                                  int radius, int prior) const;
    void propagate(const Direction& way, int level, int toArea, const LumaOnGpu& luma);
    /// Refines the vectors that start at index `in` by Gauss-Newton steps.
    void align(int in, const LumaOnGpu& luma, const TileBuffer& tiles);
    void filter(const Stage& stage, const Field& out, const TileBuffer& tiles);

    Flow2dOptions options_;
    std::vector<Stage> forwardStages_, backwardStages_;
    Field forward_, backward_;
    bool errorsGiven_ = false;
    int seed_;  // index of the first vec4 of refine()'s input vectors
    gpu::Buffer cells_;
    TileLists searched_;
    gpu::ComputePass<params::SearchFlow> search_, searchListed_;
    gpu::ComputePass<params::RefineFlow> propagate_, align_;
    gpu::ComputePass<params::FilterFlow> filter_;
};

}  // namespace mfar
