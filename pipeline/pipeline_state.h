#pragma once

#include "pipeline/composite/scene_follower.h"
#include "pipeline/composite/virtual_view.h"
#include "pipeline/depth/depth_stage.h"
#include "pipeline/depth/edge_snap.h"
#include "pipeline/epipolar/epipolar_flow.h"
#include "pipeline/pipeline.h"
#include "pipeline/plan/camera_rest.h"
#include "pipeline/plan/second_tiles.h"
#include "pipeline/reference.h"
#include "pipeline/stage_clock.h"

#include <future>
#include <memory>
#include <optional>

namespace mfar {

/// A flow vector that ends farther than this from its epipolar line [px] cannot belong to a static
/// point.
inline constexpr float kOffLine = 3;

/// The data that Pipeline keeps between frames. Data of a single frame is passed in arguments and
/// return values instead. The member functions for depth and virtual objects are in
/// pipeline_objects.cpp, all others in pipeline.cpp.
struct Pipeline::State {
    State(const StereoRig& rig, const PipelineOptions& options);

    /// Results of a frame's flow step that the depth measurement needs. `searched2d` has one entry
    /// per tile: true if the tile was searched in both dimensions.
    struct DepthMatches {
        EpipolarFlow::Cells vectors;
        std::vector<bool> searched2d;
    };
    /// Work on the depth of one frame. If `measures` is false, nothing is done. If `measures` is
    /// true but `isDue` is false, the last depth is moved to this frame. If both are true, depth is
    /// measured in `where` [video px]. `matches` is empty if `isDue` is false or if the flow was
    /// not searched along epipolar lines.
    struct DepthTask {
        PixelRect where;
        bool measures = false;
        std::optional<DepthMatches> matches;
        bool isDue = false;
    };
    struct RealDepth {
        RealDepth(const CameraModel& video, const std::shared_ptr<Workers>& workers,
                  const DepthOptions& options)
            : stage(video, workers, options), snap(video.size, workers) {}

        DepthStage stage;
        EdgeSnap snap;
        LumaImage luma;
    };
    struct Match {
        const FlowCells& flow;
        const CellWeights& weights;
        const CellWeights* second = nullptr;
    };

    /// Starts a thread that creates the epipolar search, so that the first pictures do not have to
    /// wait for it. Does nothing if the search exists or is already being created.
    void beginEpipolar();
    /// Returns the epipolar search. If it does not exist yet, creates it, or waits for the thread
    /// that creates it.
    EpipolarFlow& needEpipolar();
    void needDepth();
    PixelRect placeObjects(const std::optional<Pose>& pose, Timestamp time);
    const TileWork& planFrame(const VideoFrame& frame);
    /// Matches the frame with the newest still: along epipolar lines if `pose` is set, otherwise in
    /// both dimensions. `pose` may be set only if EpipolarFlow::matches() is true for it. In the
    /// area `forDepth` [video px], the depth measurement needs the results of the epipolar search.
    Match matchStill(const VideoFrame& frame, const TileWork& work, const std::optional<Pose>& pose,
                     const PixelRect& forDepth);
    const CellWeights& weighed(const Reference& still, const VideoFrame& frame,
                               const LumaPyramid& pyramids, const FlowCells& flow,
                               const TileWork& work);
    /// Must be called before a new still is stored. Makes the newest still the second one, unless
    /// keepsOlder() prefers the present second still. If keepsSecond() is false, there is no second
    /// still afterwards.
    void retireNewest();
    /// Matches the second still in tiles that the newest still does not show. Returns null if there
    /// is no such tile or no second still. Must be called after matchStill().
    const CellWeights* matchSecond(const VideoFrame& frame, const TileWork& work);
    /// Decides if depth is measured, and copies the flow results that the measurement needs. Must
    /// be called before the frame is drawn, because a later copy would have to wait until the GPU
    /// has drawn the frame. `alongLines` is the flow if it was searched along epipolar lines, else
    /// null.
    DepthTask prepareDepth(const PixelRect& where, bool hasPose, const FlowCells* alongLines);
    void listen(const CellWeights& weights);
    /// Reports to the listener how the newest still was matched in the last frame. Must be called
    /// before a new still replaces the newest one.
    void tellReplaced();
    [[nodiscard]] MatchedPictures::LookedUp lookedUp() const;
    void drawDetail(const VideoFrame& frame, const TileWork& work, const Match* match);
    void measureDepth(const VideoFrame& frame, Timestamp time, Pose pose, const DepthTask& task);
    void showObjects(const VideoFrame& frame);
    void followScene(const VideoFrame& frame, const std::optional<Pose>& pose, Timestamp time);
    void publish(const TileWork& work, bool usedStill);
    void publishTiles(const TileSummary& tiles, FrameStats& stats) const;

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
    [[nodiscard]] float light() const { return filterBank()->guidance().light; }
    void lap(const char* stage);

    [[nodiscard]] Reference makeReference();
    /// Returns `wanted`, or the full size for 0x0.
    static Size outputSize(const StereoRig& rig, Size wanted);

    StereoRig rig;
    PipelineOptions options;
    Size output;
    std::shared_ptr<Workers> workers;
    Transfers transfers, transfersBefore;
    std::unique_ptr<Engine> gles, simd;
    Reference newest, second;
    std::unique_ptr<DetailStep> detail;
    // now: the video of this frame. drawn: for each tile, its video when it was last drawn.
    RgbPlanes now, drawn;
    WorkPlan plan;
    CameraRest rest;
    SecondTiles secondTiles;
    std::unique_ptr<EpipolarFlow> epipolar;
    std::future<std::unique_ptr<EpipolarFlow>> comingEpipolar;
    std::optional<RealDepth> depth;
    std::optional<VirtualView> objects;
    TracedLayerOptions traced;
    std::optional<SceneFollower> sceneFollower;
    std::optional<LightFollower> lightFollower;
    std::optional<Lighting> newLight;  // for the next frame with objects in view
    Quality quality;
    std::shared_ptr<const FilterBank> filters, nextFilters;  // null means the built-in filters
    MatchListener* matchListener = nullptr;
    // True if no frame was matched with the newest still in mode Detail yet.
    bool isNewStill = false;
    bool redraw = true;
    int depthAge = 0;  // number of frames that needed depth since depth was last measured
    std::uint64_t frames = 0;
    StageClock clock;
    FrameResult result;
};

}  // namespace mfar
