#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/detail.h"
#include "pipeline/engine/steps.h"
#include "pipeline/gles/learned_enlarger.h"
#include "pipeline/gles/tile_buffer.h"
#include "pipeline/gles/tile_pass.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Combines the video, a still and its weights into the output picture. Draws only the tiles that
/// TileWork requests. Other tiles keep their pixels from earlier frames.
class DetailPainter {
public:
    /// The still camera of `stillRig` must have the resolution of Matched::still.
    DetailPainter(const StereoRig& stillRig, Size output);

    struct Matched {
        /// The still with a linear filter: StillReference::raised(), or in mode Blend the still
        /// itself.
        const gpu::Texture& still;
        /// See CellWeigher::weighed(), lookUps() and trust().
        const gpu::Texture& weighed;
        const gpu::Texture& lookUps;
        const gpu::Texture& trust;
        /// A second still, or null; see DetailStep::Matched::second.
        const Matched* second = nullptr;
    };
    /// Finds the classes of the tiles that `tiles` requests, and draws these tiles. If `matched` is
    /// null, they show only the enlarged video.
    void draw(const gpu::Texture& video, const Matched* matched, const TileBuffer& tiles,
              const DetailOptions& options);

    [[nodiscard]] const gpu::Texture& output() const { return output_; }
    [[nodiscard]] const gpu::Framebuffer& target() const { return outputTarget_; }

    /// Summary of the frame before the last one. Does not wait for the GPU.
    [[nodiscard]] TileSummary summaryBefore() const { return summary(1 - current_); }
    /// Summary of the last frame. Waits for the GPU.
    [[nodiscard]] TileSummary summaryNow() const { return summary(current_); }
    /// Classes of all tiles in the last frame, row-major. Waits for the GPU.
    [[nodiscard]] std::vector<TileClass> readClasses() const;

private:
    using TileParams = params::DrawTiles;
    struct Linear {
        Linear()
            : columns("superres_vertical.frag", "#define LINEAR\n"),
              rows("composite_enlarge.frag", "#define LINEAR\n") {}

        TilePass columns, rows;
    };
    struct Composites {
        TilePass& enlarged;
        gpu::DrawPass<TileParams>& whole;
        gpu::DrawPass<TileParams>& tiles;
        gpu::DrawPass<TileParams>& plain;
    };
    struct DrawBlock {
        std::array<std::array<std::uint32_t, 4>, 5> commands;
        std::array<std::uint32_t, 8> counts;
    };
    enum class List : std::uint32_t { All, Enlarged, Trusted, Blended, Second };

    [[nodiscard]] TileSummary summary(int which) const;
    [[nodiscard]] gpu::InstanceList list(List which) const;
    void classify(const Matched* matched, const TileBuffer& tiles, const DetailOptions& options);
    void sharpen(const TileParams& params, const gpu::Texture& video, const Matched& matched,
                 const TileWork& work);
    void enlargeLearned(const TileParams& params, const gpu::Texture& video, const Matched* matched,
                        const TileBuffer& tiles, const FilterBank& filters);
    void enlargeColumns(const TileParams& params, const gpu::Texture& video, const Matched* matched,
                        const TileBuffer& tiles, const DetailOptions& options);
    void drawSecond(const TileParams& params, const gpu::Texture& video, const Matched& matched,
                    const FilterBank& filters);
    void composite(Composites passes, const TileParams& params, gpu::Bindings bindings,
                   bool isMatched, const TileWork& work);
    void drawDetail(Composites passes, const TileParams& params, gpu::Bindings bindings,
                    const TileWork& work);
    [[nodiscard]] PixelRect outputOf(const PixelRect& tiles) const;
    [[nodiscard]] TileParams tileParams() const;
    [[nodiscard]] Composites compositesFor(const DetailOptions& options);

    StereoRig rig_;
    Size video_, cells_, tiles_;
    gpu::Texture blank_, sharpened_, columns_, output_;
    gpu::Framebuffer sharpenedTarget_, columnsTarget_, outputTarget_;
    gpu::Buffer classes_, lists_;
    std::array<gpu::Buffer, 2> draws_;
    int current_ = 0, restingFrames_ = 0;
    std::uint32_t classified_ = 0;
    // True if the texture (sharpened_, columns_) was not computed for the last drawn frame.
    bool sharpenedIsOld_ = true, columnsAreOld_ = true;
    gpu::ComputePass<params::ClassifyTiles> classify_;
    TilePass sharpen_, columnsPass_;
    DetailPasses detailPasses_;
    gpu::DrawPass<TileParams> wholeBlend_, blend_, plainBlend_;
    std::optional<Linear> linear_;
    std::optional<LearnedEnlarger> learned_;
};

}  // namespace mfar
