#pragma once

#include "pipeline/composite/scene_follower.h"
#include "pipeline/composite/virtual_view.h"
#include "pipeline/depth/depth_stage.h"
#include "pipeline/depth/edge_snap.h"
#include "pipeline/epipolar/epipolar_flow.h"
#include "pipeline/pipeline.h"
#include "pipeline/plan/second_tiles.h"
#include "pipeline/reference.h"
#include "pipeline/stage_clock.h"

#include <future>
#include <memory>
#include <optional>

namespace mfar {

/// A flow vector so far from its pixel's epipolar line is not that of a point at rest [px].
inline constexpr float kOffLine = 3;

/// What Pipeline keeps from frame to frame; shared by pipeline.cpp (the frame path),
/// pipeline_objects.cpp and readback.cpp. What lives for one frame is passed and returned.
struct Pipeline::State {
    State(const StereoRig& rig, const PipelineOptions& options);

    /// What depth takes from a frame's flow.
    struct DepthMatches {
        EpipolarFlow::Cells vectors;
        std::vector<bool> searched2d;  ///< tiles
    };
    /// Real depth of one frame.
    struct DepthTask {
        PixelRect where;  ///< where it is needed [video px]
        bool measures = false;
        std::optional<DepthMatches> matches;  ///< found along lines
        bool isDue = false;                   ///< measured anew, not carried on
    };
    struct RealDepth {
        RealDepth(const CameraModel& video, const std::shared_ptr<Workers>& workers,
                  const DepthOptions& options)
            : stage(video, workers, options), snap(video.size, workers) {}

        DepthStage stage;
        EdgeSnap snap;
        LumaImage luma;  // of a frame without a search along lines
    };
    /// How the still matches a frame.
    struct Match {
        const FlowCells& flow;
        const CellWeights& weights;
        const CellWeights* second = nullptr;  ///< of the second still, where that is used
    };

    /// Begins to make what searches along lines, in a thread of its own: the first picture does not
    /// wait for it, and the still that needs it comes later.
    void beginEpipolar();
    /// Makes it, or waits for what was begun.
    EpipolarFlow& needEpipolar();
    /// Allocates what measures real depth.
    void needDepth();
    /// Where real depth is needed in this frame [video px].
    PixelRect placeObjects(const std::optional<Pose>& pose, Timestamp time);
    const TileWork& planFrame(const VideoFrame& frame);
    /// Along epipolar lines where a pose is given, else in both dimensions.
    Match matchStill(const VideoFrame& frame, const TileWork& work, const std::optional<Pose>& pose,
                     const PixelRect& forDepth);
    /// How far a still is trusted.
    const CellWeights& weighed(const Reference& still, const VideoFrame& frame,
                               const LumaPyramid& pyramids, const FlowCells& flow,
                               const TileWork& work);
    /// Before a new still comes: keeps the newest as the second, where that is worth more.
    void retireNewest();
    /// Matches the second still with the tiles that the newest does not show; null where there are
    /// none. After matchStill().
    const CellWeights* matchSecond(const VideoFrame& frame, const TileWork& work);
    /// Decides whether depth is measured, and takes from the flow what that needs: a read after the
    /// frame's drawing has begun would wait for the drawing.
    DepthTask prepareDepth(const PixelRect& where, bool hasPose, const FlowCells* alongLines);
    void listen(const CellWeights& weights);
    /// Before a new still comes: tells the listener how the newest was matched.
    void tellReplaced();
    [[nodiscard]] MatchedPictures::LookedUp lookedUp() const;
    void drawDetail(const VideoFrame& frame, const TileWork& work, const Match* match);
    void measureDepth(const VideoFrame& frame, const Pose& pose, const DepthTask& task);
    void showObjects(const VideoFrame& frame);
    /// For the next frame: what this one has shown of the real scene around the objects.
    void followScene(const VideoFrame& frame, const std::optional<Pose>& pose, Timestamp time);
    void publish(const TileWork& work, bool usedStill, bool usedPose);

    [[nodiscard]] PixelRect pixelsOf(const PixelRect& tiles) const;
    [[nodiscard]] bool inView() const { return objects && !objects->region().empty(); }
    [[nodiscard]] bool drawsObjects() const { return objects && plan.redraws(); }
    void keepDrawn(const TileWork& work);
    void forgetMoving(const DepthMatches& matches);
    [[nodiscard]] bool leavesLines(const PixelRect& tile, const EpipolarFlow::Cells& vectors) const;
    [[nodiscard]] Engine& engineOf(EngineKind kind);
    [[nodiscard]] bool keepsSecond() const {
        return quality.mode == SuperResMode::Detail && quality.learned && quality.secondShare > 0;
    }
    [[nodiscard]] const FilterBank* filterBank() const {
        return filters ? filters.get() : &FilterBank::prior();
    }
    /// Closes a stage of the frame.
    void lap(const char* stage);

    [[nodiscard]] Reference makeReference();
    /// The size asked for, or the full one.
    static Size outputSize(const StereoRig& rig, Size wanted);

    StereoRig rig;
    PipelineOptions options;
    Size output;
    std::shared_ptr<Workers> workers;
    Transfers transfers, transfersBefore;  // in all
    std::unique_ptr<Engine> gles, simd;    // as far as the choice needs them
    Reference newest, second;
    std::unique_ptr<DetailStep> detail;
    RgbPlanes now, drawn;  // the frame, and what each tile was last drawn from
    WorkPlan plan;
    SecondTiles secondTiles;
    std::unique_ptr<EpipolarFlow> epipolar;  // since the first still with a pose
    std::future<std::unique_ptr<EpipolarFlow>> comingEpipolar;
    std::optional<RealDepth> depth;  // since it is needed for the first time
    std::optional<VirtualView> objects;
    TracedLayerOptions traced;  // of path traced objects
    std::optional<SceneFollower> sceneFollower;
    std::optional<LightFollower> lightFollower;
    Quality quality;
    std::shared_ptr<const FilterBank> filters, nextFilters;  // null: the shipped ones
    MatchListener* matchListener = nullptr;
    bool isNewStill = false;  // no frame was matched to it
    bool redraw = true;       // nothing of the last output may stay
    int depthAge = 0;         // frames since depth was measured
    std::uint64_t frames = 0;
    StageClock clock;
    FrameResult result;
};

}  // namespace mfar
