#pragma once

#include "pipeline/flow/flow2d.h"
#include "pipeline/pipeline.h"
#include "pipeline/superres/still_reference.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// Turns flow and still into the high-resolution picture. Only the tiles that the plan calls
/// changed are drawn; the others keep their pixels from earlier frames.
class SuperRes {
public:
    SuperRes(const StereoRig& rig, Size output, SuperResMode mode, const LumaPyramids& pyramids,
             WorkPlan& plan);

    /// Weighs the still cell by cell. `still` is nullptr when there is none (upscaling only).
    void assess(const LumaPyramids& pyramids, const Flow2d& flow, const WorkPlan& plan);
    /// Sorts the changed tiles into classes and draws them.
    void draw(const gpu::Texture& video, const StillReference* still, const WorkPlan& plan);

    void setMode(SuperResMode mode) { mode_ = mode; }
    /// Of the enlarged video: Keys' cubic, or linear.
    void setCubic(bool cubic) { cubic_ = cubic; }
    void setSkips(const SkipOptions& skips) { skips_ = skips; }
    [[nodiscard]] const gpu::Texture& output() const { return output_; }
    /// Draws into output(), for what comes over it.
    [[nodiscard]] const gpu::Framebuffer& target() const { return outputTarget_; }
    /// Per cell: flow (x, y) [video px], weight of the detail, eq. 2 confidence. Rgba32F.
    [[nodiscard]] const gpu::Texture& cellField() const { return cellField_; }

    /// Counts of the frame before the last one drawn: already there, nothing waits for them.
    [[nodiscard]] FrameStats statsBefore() const { return stats(1 - current_); }
    /// Counts of the last frame. Waits for the GPU.
    [[nodiscard]] FrameStats statsNow() const { return stats(current_); }
    /// Class of every tile in the last frame, row-major. Waits for the GPU.
    [[nodiscard]] std::vector<TileClass> readClasses() const;

private:
    struct AssessParams {
        RigParams rig;
        LumaLevel video, still;
        std::int32_t cells[4], offsets[4];
        float tune[4], stillSize[4];
    };
    struct GainParams {
        LumaLevel video, still;
        std::int32_t cells[4], offsets[4];
    };
    struct WeighParams {
        std::int32_t cells[4];
        float tune[4];
    };
    struct ClassifyParams {
        std::int32_t tiles[4];
        float tune[4];
    };
    struct TileParams {  // tile_params.glsl
        std::int32_t video[4];
        float scale[4], tune[4];
    };
    /// The same shader over the whole target and over a list of tiles; the plan opens one of them.
    struct TilePass {
        explicit TilePass(const char* fragment, const char* defines = "")
            : whole(fragment, defines), tiles("tile_rect.vert", fragment, defines) {}
        gpu::DrawPass<TileParams> whole, tiles;
    };
    struct Enlarging {
        explicit Enlarging(const char* defines = "")
            : columns("superres_vertical.frag", defines), rows("composite_upscale.frag", defines) {}
        TilePass columns, rows;
    };
    /// draws[] of superres_classify.comp.
    struct DrawBlock {
        std::array<std::array<std::uint32_t, 4>, 4> commands;
        std::array<std::uint32_t, 8> counts;
    };
    enum class List : std::uint32_t { All, Upscaled, Trusted, Blended };

    [[nodiscard]] FrameStats stats(int which) const;
    [[nodiscard]] gpu::InstanceList list(List which) const;
    void measureGain(const LumaPyramids& pyramids, const Flow2d& flow, const WorkPlan& plan);
    void weigh(const WorkPlan& plan);
    void classify(const WorkPlan& plan, bool hasStill);
    void sharpen(const TileParams& params, const gpu::Texture& video, const WorkPlan& plan);
    void drawBoth(TilePass& pass, const TileParams& params, gpu::Bindings bindings,
                  const gpu::Framebuffer& target, const WorkPlan& plan);
    void drawDetail(gpu::DrawPass<TileParams>& detail, const TileParams& params,
                    gpu::Bindings bindings, const WorkPlan& plan);
    [[nodiscard]] PixelRect outputOf(const PixelRect& tiles) const;
    [[nodiscard]] TileParams tileParams(bool useStill) const;
    [[nodiscard]] Enlarging& enlarging();

    StereoRig rig_;
    SuperResMode mode_;
    SkipOptions skips_;
    Size video_, cells_, halfCells_, tiles_;
    gpu::Texture displacement_, statistics_, halfStatistics_, cellField_, weightField_,
        lookupField_, sharpened_, columns_, output_;
    gpu::Framebuffer sharpenedTarget_, columnsTarget_, outputTarget_;
    gpu::Buffer classes_, lists_;
    std::array<gpu::Buffer, 2> draws_;
    int current_ = 0, restingFrames_ = 0;
    bool sharpenedIsOld_ = true;  // of a frame before the last
    bool cubic_ = true;
    WorkPlan::Dispatch assessDispatch_, gainDispatch_, weighDispatch_;
    gpu::ComputePass<AssessParams> assess_;
    gpu::ComputePass<GainParams> gain_;
    gpu::ComputePass<WeighParams> weigh_;
    gpu::ComputePass<ClassifyParams> classify_;
    TilePass sharpen_;
    Enlarging cubicly_;
    std::optional<Enlarging> linearly_;  // from the first frame on that wants it
    gpu::DrawPass<TileParams> wholeDetail_, wholeBlend_;
    gpu::DrawPass<TileParams> detail_, plainDetail_, blend_, plainBlend_;
};

}  // namespace mfar
