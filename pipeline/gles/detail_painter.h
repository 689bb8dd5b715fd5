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

/// Turns video, still and weights into the high-resolution picture. Only the tiles that the plan
/// calls changed are drawn; the others keep their pixels from earlier frames.
class DetailPainter {
public:
    /// `stillRig`: with the still camera as its detail and picture are.
    DetailPainter(const StereoRig& stillRig, Size output);

    /// A still on the GPU, and how it matches.
    struct Matched {
        const gpu::Texture& still;    ///< raised luma, or the picture in mode Blend; linear filter
        const gpu::Texture& weighed;  ///< Rgba32F, as the other two one texel a cell
        const gpu::Texture& lookUps;  ///< Rgba16F, linear filter
        const gpu::Texture& trust;    ///< Rgba8, linear filter
        /// Seen where it counts for more; null: none. In mode Detail with filters alone.
        const Matched* second = nullptr;
    };
    /// Sorts the changed tiles into classes and draws them. Null: only enlarges.
    void draw(const gpu::Texture& video, const Matched* matched, const TileBuffer& tiles,
              const DetailOptions& options);

    [[nodiscard]] const gpu::Texture& output() const { return output_; }
    /// Draws into output(), for what comes over it.
    [[nodiscard]] const gpu::Framebuffer& target() const { return outputTarget_; }

    /// Counts of the frame before the last one drawn: already there, nothing waits for them.
    [[nodiscard]] TileSummary summaryBefore() const { return summary(1 - current_); }
    /// Counts of the last frame. Waits for the GPU.
    [[nodiscard]] TileSummary summaryNow() const { return summary(current_); }
    /// Class of every tile in the last frame, row-major. Waits for the GPU.
    [[nodiscard]] std::vector<TileClass> readClasses() const;

private:
    using TileParams = params::DrawTiles;
    /// Enlarges linearly.
    struct Linear {
        Linear()
            : columns("superres_vertical.frag", "#define LINEAR\n"),
              rows("composite_upscale.frag", "#define LINEAR\n") {}

        TilePass columns, rows;
    };
    /// Draws tiles of one kind, or the detail of a whole frame.
    struct Composites {
        TilePass& enlarged;
        gpu::DrawPass<TileParams>& whole;
        gpu::DrawPass<TileParams>& tiles;
        gpu::DrawPass<TileParams>& plain;
    };
    /// draws[] of superres_classify.comp.
    struct DrawBlock {
        std::array<std::array<std::uint32_t, 4>, 5> commands;
        std::array<std::uint32_t, 8> counts;
    };
    enum class List : std::uint32_t { All, Upscaled, Trusted, Blended, Second };

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
    std::uint32_t classified_ = 0;  // frames
    bool sharpenedIsOld_ = true;    // from a frame before the last
    gpu::ComputePass<params::ClassifyTiles> classify_;
    TilePass sharpen_, columnsPass_;
    DetailPasses detailPasses_;
    gpu::DrawPass<TileParams> wholeBlend_, blend_, plainBlend_;
    // Made for the first frame that wants it.
    std::optional<Linear> linear_;
    std::optional<LearnedEnlarger> learned_;
};

}  // namespace mfar
