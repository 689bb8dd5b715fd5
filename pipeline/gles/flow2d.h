#pragma once

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/gles/tile_lists.h"

#include <array>
#include <span>
#include <vector>

namespace mfar {

/// Computes the dense flow from video to still (forward) and from still to video (backward) without
/// the cameras' pose. Its parts are a coarse-to-fine inverse search, propagation, Gauss-Newton
/// refinement, and the removal of outliers and noise. Each cell is matched by the 8x8 patch around
/// it. A brightness offset does not change the cost of a match, and a gain hardly changes it.
/// Sources: Kroeger et al., ECCV 2016 (inverse search); Barnes et al., 2009 (propagation).
class Flow2d {
public:
    /// A part of cells() with one FlowCell per cell, starting at index `offset`.
    struct Field {
        int offset = 0;
        Size cells;
        int level = 0;
    };

    /// Throws std::invalid_argument if an option is out of range.
    explicit Flow2d(Size video, const Flow2dOptions& options = {});

    /// Sets options for the next run. Only the options that can change between frames are set (see
    /// changed() in flow_options.h). Throws std::invalid_argument if an option is out of range.
    void setOptions(const Flow2dOptions& options) { options_ = changed(options_, options); }

    /// Computes the forward and the backward field. If no tile is matched, both fields stay
    /// unchanged. If `usePrior` is true, the last frame's forward field gives a candidate for each
    /// cell of the forward field, and the search radius is smaller. `usePrior` must be false after
    /// a new still.
    void run(const LumaOnGpu& luma, const TileBuffer& tiles, bool usePrior);

    /// Computes the forward field by refining `forward`, which has one flow vector per cell: the
    /// first two numbers of an entry [px]. These vectors must be right to within a pixel. The first
    /// number of each entry of `errors` is the cell's two-way error (eq. 2 of the paper, see
    /// docs/paper.md) [px]. Tiles in which the vectors match badly are searched again, in two
    /// dimensions from coarse to fine. If no tile is matched, the forward field stays unchanged.
    using Cells = std::span<const std::array<float, 4>>;
    void refine(const LumaOnGpu& luma, const TileBuffer& tiles, Cells forward, Cells errors);

    [[nodiscard]] const TileLists& searched() const { return searched_; }

    [[nodiscard]] const gpu::Buffer& cells() const { return cells_; }
    [[nodiscard]] const Field& forward() const { return forward_; }
    /// True after refine(): backward() then has the ErrorCells of forward() instead of flow
    /// vectors. False after run(). Without matched tiles, neither call changes it.
    [[nodiscard]] bool errorsGiven() const { return errorsGiven_; }
    [[nodiscard]] const Field& backward() const { return backward_; }
    /// refine() gets one vector per cell. The buffer cells() contains these vectors from this index
    /// on.
    [[nodiscard]] int seed() const { return seed_; }

private:
    /// The memory in cells_ for the flow in one direction at one pyramid level. `area`: indices of
    /// the first cells of two areas. There are two, because propagation reads one and writes the
    /// other.
    struct Stage {
        Size cells;
        int area[2];
        gpu::Groups groups;
    };
    struct Direction {
        const std::vector<LumaLevel>& from;
        const std::vector<LumaLevel>& to;
        const std::vector<Stage>& stages;
        int finest;
        int finestPropagations;
        bool usePrior;
    };

    void run(const Direction& way, const LumaOnGpu& luma);
    void search(const Direction& way, int level, int area, const LumaOnGpu& luma);
    void searchListed(const LumaOnGpu& luma);
    [[nodiscard]] params::SearchFlow searchParams(const Direction& way, int level, int area,
                                                  int radius, int prior) const;
    void propagate(const Direction& way, int level, int toArea, const LumaOnGpu& luma);
    void align(int in, const LumaOnGpu& luma, const TileBuffer& tiles);
    void filter(const Stage& stage, const Field& out, const TileBuffer& tiles);

    Flow2dOptions options_;
    std::vector<Stage> forwardStages_, backwardStages_;
    Field forward_, backward_;
    bool errorsGiven_ = false;
    int seed_;
    gpu::Buffer cells_;
    TileLists searched_;
    gpu::ComputePass<params::SearchFlow> search_, searchListed_;
    gpu::ComputePass<params::RefineFlow> propagate_, align_;
    gpu::ComputePass<params::FilterFlow> filter_;
};

}  // namespace mfar
