#pragma once

#include "pipeline/composite/virtual_view.h"
#include "pipeline/depth/depth_stage.h"
#include "pipeline/depth/edge_snap.h"
#include "pipeline/epipolar/epipolar_flow.h"
#include "pipeline/flow/flow2d.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/pipeline.h"
#include "pipeline/superres/superres.h"

#include <chrono>

namespace mfar {

/// A flow vector so far from its pixel's epipolar line is not that of a point at rest [px].
inline constexpr float kOffLine = 3;

/// What depth takes from a frame's flow.
struct DepthMatches {
    EpipolarFlow::Cells vectors;
    std::vector<bool> searched2d;  ///< tiles
};

/// What Pipeline keeps; shared by pipeline.cpp (the frame path) and readback.cpp.
struct Pipeline::State {
    State(const StereoRig& rigIn, const PipelineOptions& optionsIn)
        : rig(rigIn), options(optionsIn), workers(std::make_shared<Workers>()), now(rig.video.size),
          drawn(rig.video.size), plan(rig.video.size, workers), pyramids(rig.video.size, plan),
          flow(pyramids, plan, options.flow2d), epipolar(rig, workers, options.epipolar),
          still(rig, outputSize(rig, options.output)), depth(rig.video, workers, options.depth),
          snap(rig.video.size, workers),
          superres(still.rig(), outputSize(rig, options.output), options.mode, pyramids, plan) {
        superres.setSkips(options.skips);
        if (!options.skips.tileLists) plan.drawWholeFrom(0);
        stageTimes.reserve(8);
        result.image = {superres.output().id(), superres.output().size()};
    }

    /// Closes a stage: its time since the last call, with the GPU's work when measuring.
    void lap(const char* stage) {
        if (measure) glFinish();
        const auto now = std::chrono::steady_clock::now();
        stageTimes.push_back(
            {stage, std::chrono::duration<double, std::milli>(now - lastLap).count()});
        lastLap = now;
    }

    /// Tells the plan which tiles the frame is to match.
    void limitMatching();
    /// After drawing.
    void keepDrawn();
    [[nodiscard]] PixelRect pixelsOf(const PixelRect& tiles) const;
    /// `forDepth`: where depth is measured by it [video px].
    void matchStill(const ImageView& frame, const std::optional<Pose>& pose,
                    const PixelRect& forDepth);
    /// Says where real depth is needed in this frame [video px].
    PixelRect placeObjects(const std::optional<Pose>& pose, Timestamp time);
    [[nodiscard]] bool inView() const { return objects && !objects->region().empty(); }
    /// Decides whether objects are drawn and depth is measured `where` it is needed, and takes from
    /// the flow what it is measured by: a read after the frame's drawing has begun would wait for
    /// that.
    void prepareDepth(bool hasPose, bool searched, const PixelRect& where);
    void measureDepth(const ImageView& frame, const Pose& pose, const PixelRect& where);
    void showObjects(const ImageView& frame, Timestamp time, const std::optional<Pose>& pose,
                     const PixelRect& where);
    void forgetMoving(const DepthMatches& matches);
    [[nodiscard]] bool leavesLines(const PixelRect& tile, const EpipolarFlow::Cells& vectors) const;

    /// The size asked for, or the full one.
    static Size outputSize(const StereoRig& rig, Size wanted);

    StereoRig rig;
    PipelineOptions options;
    std::shared_ptr<Workers> workers;
    gpu::PictureTexture video;
    RgbPlanes now, drawn;  // the frame, and what each tile was last drawn from
    WorkPlan plan;
    LumaPyramids pyramids;
    Flow2d flow;
    EpipolarFlow epipolar;
    StillReference still;
    DepthStage depth;
    EdgeSnap snap;
    LumaImage luma;  // of the frame, where the search along lines did not run
    SuperRes superres;
    std::optional<VirtualView> objects;
    TracedLayerOptions traced;  // of objects that are path traced
    bool hasStill = false;
    bool redraw = true;  // nothing of the last output may stay
    bool alongLines = true;
    double detailShare = 1;
    int depthEvery = 1, depthAge = 0;  // frames; since depth was measured
    bool draws = false, measures = false, depthIsDue = false;
    std::optional<DepthMatches> matches;  // of this frame, found along lines
    bool hasPrior = false;                // the flow field of the last frame belongs to this still
    bool measure = false;
    FrameResult result;
    std::vector<StageTime> stageTimes;
    std::chrono::steady_clock::time_point lastLap;
};

}  // namespace mfar
