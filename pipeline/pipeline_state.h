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

/// A flow vector at least this far from its pixel's epipolar line cannot belong to a static point
/// [px].
inline constexpr float kOffLine = 3;

/// State that Pipeline keeps between frames; shared by pipeline.cpp (the frame path),
/// pipeline_objects.cpp and readback.cpp. Data of a single frame is passed and returned instead.
struct Pipeline::State {
    State(const StereoRig& rig, const PipelineOptions& options);

    /// Data of a frame's flow that depth needs.
    struct DepthMatches {
        EpipolarFlow::Cells vectors;
        std::vector<bool> searched2d;  ///< by tile
    };
    /// Depth measurement of one frame.
    struct DepthTask {
        PixelRect where;  ///< where it is needed [video px]
        bool measures = false;
        std::optional<DepthMatches> matches;  ///< found along epipolar lines
        bool isDue = false;                   ///< measured again instead of carried on
    };
    struct RealDepth {
        RealDepth(const CameraModel& video, const std::shared_ptr<Workers>& workers,
                  const DepthOptions& options)
            : stage(video, workers, options), snap(video.size, workers) {}

        DepthStage stage;
        EdgeSnap snap;
        LumaImage luma;  // luma of frames without an epipolar search
    };
    /// A frame's match with the still.
    struct Match {
        const FlowCells& flow;
        const CellWeights& weights;
        const CellWeights* second = nullptr;  ///< for the second still, if used
    };

    /// Starts creating the epipolar search in a thread, so that the first picture does not wait for
    /// it; the still that needs it comes later.
    void beginEpipolar();
    /// Creates the epipolar search, or waits for the thread that creates it.
    EpipolarFlow& needEpipolar();
    /// Allocates depth measurement.
    void needDepth();
    /// Where real depth is needed in this frame [video px].
    PixelRect placeObjects(const std::optional<Pose>& pose, Timestamp time);
    const TileWork& planFrame(const VideoFrame& frame);
    /// Searches along epipolar lines if a pose is given, otherwise in both dimensions.
    Match matchStill(const VideoFrame& frame, const TileWork& work, const std::optional<Pose>& pose,
                     const PixelRect& forDepth);
    /// The weight of each cell of a still.
    const CellWeights& weighed(const Reference& still, const VideoFrame& frame,
                               const LumaPyramid& pyramids, const FlowCells& flow,
                               const TileWork& work);
    /// Called before a new still is taken: keeps the newest as the second if it is worth more.
    void retireNewest();
    /// Matches the second still in the tiles that the newest does not show; null without such
    /// tiles. Call after matchStill().
    const CellWeights* matchSecond(const VideoFrame& frame, const TileWork& work);
    /// Decides whether depth is measured, and reads what it needs from the flow: a read after the
    /// frame's drawing has begun would wait for the drawing.
    DepthTask prepareDepth(const PixelRect& where, bool hasPose, const FlowCells* alongLines);
    void listen(const CellWeights& weights);
    /// Called before a new still is taken: reports to the listener how the newest was matched.
    void tellReplaced();
    [[nodiscard]] MatchedPictures::LookedUp lookedUp() const;
    void drawDetail(const VideoFrame& frame, const TileWork& work, const Match* match);
    void measureDepth(const VideoFrame& frame, const Pose& pose, const DepthTask& task);
    void showObjects(const VideoFrame& frame);
    /// For the next frame: records what this frame shows of the real scene around the objects.
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
    /// Ends a stage of the frame.
    void lap(const char* stage);

    [[nodiscard]] Reference makeReference();
    /// The wanted size, or the full size for 0x0.
    static Size outputSize(const StereoRig& rig, Size wanted);

    StereoRig rig;
    PipelineOptions options;
    Size output;
    std::shared_ptr<Workers> workers;
    Transfers transfers, transfersBefore;  // running totals
    std::unique_ptr<Engine> gles, simd;    // only those that the choice needs
    Reference newest, second;
    std::unique_ptr<DetailStep> detail;
    RgbPlanes now, drawn;  // the current frame, and the video that each tile was last drawn from
    WorkPlan plan;
    SecondTiles secondTiles;
    std::unique_ptr<EpipolarFlow> epipolar;  // set from the first still with a pose on
    std::future<std::unique_ptr<EpipolarFlow>> comingEpipolar;
    std::optional<RealDepth> depth;  // set when first needed
    std::optional<VirtualView> objects;
    TracedLayerOptions traced;  // for path traced objects
    std::optional<SceneFollower> sceneFollower;
    std::optional<LightFollower> lightFollower;
    Quality quality;
    std::shared_ptr<const FilterBank> filters, nextFilters;  // null: the built-in filters
    MatchListener* matchListener = nullptr;
    bool isNewStill = false;  // no frame has been matched to it
    bool redraw = true;       // no tile of the last output may be kept
    int depthAge = 0;         // frames since depth was last measured
    std::uint64_t frames = 0;
    StageClock clock;
    FrameResult result;
};

}  // namespace mfar
