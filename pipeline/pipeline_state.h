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

/// A flow vector cannot belong to a static point if it ends at least this far from the epipolar
/// line [px].
inline constexpr float kOffLine = 3;

/// The data of Pipeline between frames. Data of a single frame is not stored here, but passed as
/// arguments and returned. pipeline.cpp processes frames; pipeline_objects.cpp and readback.cpp
/// contain other member functions.
struct Pipeline::State {
    State(const StereoRig& rig, const PipelineOptions& options);

    /// Results of a frame's flow step that the depth measurement needs. `searched2d` is true for
    /// each tile that was searched in both dimensions.
    struct DepthMatches {
        EpipolarFlow::Cells vectors;
        std::vector<bool> searched2d;
    };
    /// Depth measurement of one frame. `where` is the area that needs depth [video px]. If
    /// `measures` is false, the frame needs no depth. If only `isDue` is false, the last depth is
    /// moved to this frame. `matches` is empty if the flow did not follow epipolar lines.
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

    /// Starts a thread that creates the epipolar search, so that the first pictures need not wait.
    /// Does nothing if the search exists or is being created.
    void beginEpipolar();
    /// Returns the epipolar search. Creates it, or waits for the thread that creates it.
    EpipolarFlow& needEpipolar();
    void needDepth();
    PixelRect placeObjects(const std::optional<Pose>& pose, Timestamp time);
    const TileWork& planFrame(const VideoFrame& frame);
    /// Matches the frame with the newest still: along epipolar lines with a pose, otherwise in both
    /// dimensions. `forDepth` is the area in which the depth measurement needs the epipolar search
    /// [video px].
    Match matchStill(const VideoFrame& frame, const TileWork& work, const std::optional<Pose>& pose,
                     const PixelRect& forDepth);
    const CellWeights& weighed(const Reference& still, const VideoFrame& frame,
                               const LumaPyramid& pyramids, const FlowCells& flow,
                               const TileWork& work);
    /// Must be called before a new still is stored. The newest still becomes the second still
    /// unless keepsOlder() prefers the older one.
    void retireNewest();
    /// Matches the second still in the tiles that the newest still does not show. Returns null if
    /// there are no such tiles. Must be called after matchStill().
    const CellWeights* matchSecond(const VideoFrame& frame, const TileWork& work);
    /// Decides if depth is measured, and copies the necessary flow results. Must be called before
    /// the frame is drawn, because a later copy would wait until the GPU has drawn it. `alongLines`
    /// is the flow if it was searched along epipolar lines, else null.
    DepthTask prepareDepth(const PixelRect& where, bool hasPose, const FlowCells* alongLines);
    void listen(const CellWeights& weights);
    /// Must be called before a new still is stored. Reports to the listener how the newest still
    /// was matched.
    void tellReplaced();
    [[nodiscard]] MatchedPictures::LookedUp lookedUp() const;
    void drawDetail(const VideoFrame& frame, const TileWork& work, const Match* match);
    void measureDepth(const VideoFrame& frame, const Pose& pose, const DepthTask& task);
    void showObjects(const VideoFrame& frame);
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
    // now: video of this frame. drawn: for each tile, the video with which it was last drawn.
    RgbPlanes now, drawn;
    WorkPlan plan;
    SecondTiles secondTiles;
    std::unique_ptr<EpipolarFlow> epipolar;
    std::future<std::unique_ptr<EpipolarFlow>> comingEpipolar;
    std::optional<RealDepth> depth;
    std::optional<VirtualView> objects;
    TracedLayerOptions traced;
    std::optional<SceneFollower> sceneFollower;
    std::optional<LightFollower> lightFollower;
    Quality quality;
    std::shared_ptr<const FilterBank> filters, nextFilters;  // null means the built-in filters
    MatchListener* matchListener = nullptr;
    bool isNewStill = false;  // true if no frame was matched with the newest still yet
    bool redraw = true;
    int depthAge = 0;
    std::uint64_t frames = 0;
    StageClock clock;
    FrameResult result;
};

}  // namespace mfar
