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

/// Smallest distance of a flow vector's end from the epipolar line [px] at which the vector cannot
/// belong to a static point.
inline constexpr float kOffLine = 3;

/// What Pipeline keeps between frames. It is used by pipeline.cpp (which processes frames),
/// pipeline_objects.cpp and readback.cpp. Data that belongs to a single frame is not kept here, but
/// passed as arguments and returned.
struct Pipeline::State {
    State(const StereoRig& rig, const PipelineOptions& options);

    /// The results of a frame's flow step that the depth measurement needs.
    struct DepthMatches {
        EpipolarFlow::Cells vectors;
        std::vector<bool> searched2d;  ///< one entry per tile
    };
    /// How depth is measured in one frame.
    struct DepthTask {
        PixelRect where;  ///< where depth is needed [video px]
        bool measures = false;
        std::optional<DepthMatches> matches;  ///< present if the flow followed epipolar lines
        bool isDue = false;                   ///< true: depth is measured anew; false: the last
                                              ///< depth is carried on to this frame
    };
    struct RealDepth {
        RealDepth(const CameraModel& video, const std::shared_ptr<Workers>& workers,
                  const DepthOptions& options)
            : stage(video, workers, options), snap(video.size, workers) {}

        DepthStage stage;
        EdgeSnap snap;
        LumaImage luma;  // luma of a frame that was not matched along epipolar lines
    };
    /// Match of a frame with the newest still.
    struct Match {
        const FlowCells& flow;
        const CellWeights& weights;
        const CellWeights* second = nullptr;  ///< match with the second still; null: not used
    };

    /// Starts a thread that creates the epipolar search unless it exists. The first pictures then
    /// do not wait for its creation; it is needed only once a still with a pose arrives.
    void beginEpipolar();
    /// Returns the epipolar search. Creates it, or waits for the thread that creates it.
    EpipolarFlow& needEpipolar();
    /// Allocates memory for depth measurement unless this was done before.
    void needDepth();
    /// Places the virtual objects. Returns the rectangle in which this frame needs the real depth
    /// [video px].
    PixelRect placeObjects(const std::optional<Pose>& pose, Timestamp time);
    const TileWork& planFrame(const VideoFrame& frame);
    /// Matches the frame with the newest still: along epipolar lines if a pose is given, otherwise
    /// in both dimensions. `forDepth`: where the depth measurement needs the epipolar search [video
    /// px].
    Match matchStill(const VideoFrame& frame, const TileWork& work, const std::optional<Pose>& pose,
                     const PixelRect& forDepth);
    /// Computes the weight of each cell of the match with a still.
    const CellWeights& weighed(const Reference& still, const VideoFrame& frame,
                               const LumaPyramid& pyramids, const FlowCells& flow,
                               const TileWork& work);
    /// Must be called before a new still is stored. Keeps the newest still as the second one if
    /// keepsOlder() does not prefer the present second one.
    void retireNewest();
    /// Matches the second still in the tiles that the newest still does not show. Returns null if
    /// there are no such tiles. Must be called after matchStill().
    const CellWeights* matchSecond(const VideoFrame& frame, const TileWork& work);
    /// Decides whether depth is measured, and copies the flow results that the measurement needs.
    /// They are copied before the frame is drawn, because a later copy would wait until the GPU has
    /// drawn it. `alongLines`: the flow if it was searched along epipolar lines, else null.
    DepthTask prepareDepth(const PixelRect& where, bool hasPose, const FlowCells* alongLines);
    void listen(const CellWeights& weights);
    /// Must be called before a new still is stored. Reports to the listener how the newest still,
    /// which is about to be replaced, was matched.
    void tellReplaced();
    [[nodiscard]] MatchedPictures::LookedUp lookedUp() const;
    void drawDetail(const VideoFrame& frame, const TileWork& work, const Match* match);
    void measureDepth(const VideoFrame& frame, const Pose& pose, const DepthTask& task);
    void showObjects(const VideoFrame& frame);
    /// Records what this frame shows of the real scene around the objects, for use in the next
    /// frame.
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
    /// Ends a stage of the frame and records its duration.
    void lap(const char* stage);

    [[nodiscard]] Reference makeReference();
    /// `wanted`, or the full size if `wanted` is 0x0.
    static Size outputSize(const StereoRig& rig, Size wanted);

    StereoRig rig;
    PipelineOptions options;
    Size output;
    std::shared_ptr<Workers> workers;
    Transfers transfers, transfersBefore;  // totals now, and before this frame
    std::unique_ptr<Engine> gles, simd;    // null: no step uses this engine
    Reference newest, second;
    std::unique_ptr<DetailStep> detail;
    RgbPlanes now, drawn;  // video of this frame; for each tile, the video from which it was last
                           // drawn
    WorkPlan plan;
    SecondTiles secondTiles;
    std::unique_ptr<EpipolarFlow> epipolar;  // created for the first still with a pose
    std::future<std::unique_ptr<EpipolarFlow>> comingEpipolar;
    std::optional<RealDepth> depth;  // set when first needed
    std::optional<VirtualView> objects;
    TracedLayerOptions traced;  // options of path-traced objects
    std::optional<SceneFollower> sceneFollower;
    std::optional<LightFollower> lightFollower;
    Quality quality;
    std::shared_ptr<const FilterBank> filters, nextFilters;  // null: the built-in filters
    MatchListener* matchListener = nullptr;
    bool isNewStill = false;  // true: no frame was matched with the newest still yet
    bool redraw = true;       // true: the next frame must draw all tiles
    int depthAge = 0;         // frames since depth was last measured
    std::uint64_t frames = 0;
    StageClock clock;
    FrameResult result;
};

}  // namespace mfar
