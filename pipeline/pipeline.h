#pragma once

#include "base/geometry.h"
#include "hal/frame.h"
#include "hal/plane_importer.h"
#include "pipeline/composite/virtual_object.h"
#include "pipeline/depth/depth_options.h"
#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/engine/engine.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/match_listener.h"
#include "pipeline/flow/flow_options.h"
#include "pipeline/models/light_follower.h"
#include "pipeline/quality.h"
#include "pipeline/results.h"
#include "pipeline/skip_options.h"
#include "pipeline/stage_clock.h"
#include "pipeline/traced_layer.h"

#include <memory>
#include <optional>
#include <vector>

namespace mfar {

struct PipelineOptions {
    SuperResMode mode = SuperResMode::Detail;
    /// Output size; 0x0 is Pipeline::fullSize(). At a smaller size each output pixel averages all
    /// sensor pixels of its area.
    Size output;
    /// Whether unchanged tiles keep their pixels. If false, every tile is computed in each frame.
    bool skipUnchanged = true;
    Flow2dOptions flow2d{};
    EpipolarOptions epipolar{};
    DepthOptions depth{};
    /// Whether the real scene's depth is measured in the whole picture, for evaluation and for the
    /// preview. If false, depth is measured only where a virtual object may be occluded.
    bool depthEverywhere = false;
    SkipOptions skips{};
    /// The engine of each step. Steps on GLES need a current GL context. Without any step on GLES,
    /// setObjects() and setScene() must not be called.
    EngineChoice engines = EngineChoice::fromEnvironment();
    /// Number of CPU threads that share the work of a step. 0: one per processor, but at most four.
    int threads = 0;
};

/// Processes frames: video in, high-resolution picture out.
/// The constructor allocates what every frame needs. A thread creates the epipolar search during
/// the first frame with a pose, at the latest with the first still that has a pose. Memory for
/// depth measurement is allocated with the first object.
/// All calls must come from one thread. If a step runs on GLES, this is the GL thread, and the GL
/// context must be current. Only set-up functions throw GlError, and std::invalid_argument for
/// options out of range.
class Pipeline {
public:
    Pipeline(const StereoRig& rig, const PipelineOptions& options);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes this still the reference of the following frames. All work per still is done in this
    /// call.
    /// The still may have any format. Throws std::invalid_argument if its size is not the rig's or
    /// the view is invalid (requireSound()). `pose` is the pose of the video camera at the time of
    /// the still. If both the still and a frame have poses, the flow is searched along epipolar
    /// lines, otherwise in both dimensions.
    void setStill(const ImageView& still, Timestamp time, const std::optional<Pose>& pose = {});
    /// Time of the older still, which is kept for areas that the newest still does not show. Empty
    /// if there is no such still.
    [[nodiscard]] std::optional<Timestamp> secondStill() const;
    /// Discards the stills. The enlarged video is shown until the next still.
    void dropStill();
    /// Computes one output picture. Throws std::invalid_argument like setStill().
    const FrameResult& run(const ImageView& video, Timestamp time,
                           const std::optional<Pose>& pose = {});

    /// setMode() and setSkipUnchanged() take effect with the next run.
    void setMode(SuperResMode mode);
    void setSkipUnchanged(bool skip);
    /// Sets the filters that enlarge the video in modes that use filters. They are used from the
    /// next still on, because the picture changes then anyway. Without a still they are used at
    /// once. Null: the built-in filters.
    void setFilters(std::shared_ptr<const FilterBank> filters);
    /// Sets the object that receives each matched still while filters enlarge the video. Null: no
    /// listener. The listener must outlive the pipeline.
    void setMatchListener(MatchListener* listener);
    /// Sets the importer that uses the cameras' memory without a copy. Null: every picture is
    /// uploaded. The importer must outlive the pipeline.
    void setImporter(PlaneImporter* importer);
    /// The reason why zero-copy import failed. It is returned once.
    [[nodiscard]] std::optional<std::string> takeImportFault();
    /// Takes effect with the next run and allocates nothing. Throws std::invalid_argument if a
    /// setting is out of range.
    void setQuality(const Quality& quality);
    /// Makes the next run draw every tile again.
    void redraw();
    /// Sets objects that are shown in frames with a pose. They are seen from this pose and are
    /// occluded by nearer real surfaces. The first call with an object allocates memory for
    /// objects.
    void setObjects(std::vector<VirtualObject> objects);
    /// Like setObjects(), but the objects are path traced. After each frame the scene is adapted to
    /// the real surroundings: shadows fall onto the measured surface and, with `light`, the light
    /// is estimated from the video.
    /// The first call with an object and calls with changed options allocate memory. Throws like
    /// TracedLayer.
    void setScene(Scene scene, const TracedLayerOptions& options,
                  std::optional<LightFollower> light = {});
    /// Rectangle of the video pixels in and around the virtual objects and their shadows in the
    /// last frame. Empty if no object is in view.
    [[nodiscard]] PixelRect objectsRegion() const;
    /// Counters of the path tracer and the warp. Empty if no path tracer is used.
    [[nodiscard]] std::optional<TracedLayerCounters> tracedCounters() const;
    /// The reason why a scene could not be shown. It is returned once.
    [[nodiscard]] std::optional<std::string> takeSceneError();

    [[nodiscard]] Size outputSize() const;
    /// Default output size: as wide as the still, with the aspect ratio of the video.
    [[nodiscard]] static Size fullSize(const StereoRig& rig);
    /// Duration of each stage of the last run, measured on the CPU. After setMeasure(true), each
    /// stage waits until its work is done, so that the durations include GPU work. Otherwise frames
    /// are not delayed (default).
    [[nodiscard]] const std::vector<StageTime>& stageTimes() const;
    void setMeasure(bool measure);
    /// Waits until the last run's picture is ready for display from the GPU or from CPU memory.
    void finish(EngineKind shownFrom) const;

    /// The real scene's depth from the last run that measured it. Throws std::bad_optional_access
    /// if no object was ever set and `depthEverywhere` is off.
    [[nodiscard]] const InverseDepthField& inverseDepth() const;

    // Functions that read results back for tests, evaluation and the preview. They wait for the
    // GPU.
    /// Numbers of the last run. FrameResult::stats has the numbers of the run before, so that run()
    /// need not wait.
    [[nodiscard]] FrameStats readStats() const;
    /// Flow of every video pixel (x, y interleaved), interpolated between cells. With poses, a
    /// pixel may get the vector of its epipolar search instead. This requires that the two vectors
    /// differ by at least half a pixel, and that the cells' flow has not left the epipolar lines.
    /// Empty without a still.
    [[nodiscard]] std::vector<float> readFlow() const;
    /// Confidence (eq. 2) of every video pixel, [0, 1]. Empty without a still.
    [[nodiscard]] std::vector<float> readConfidence() const;
    /// Class of every tile, row-major, ceil(video / kTileSize) tiles.
    [[nodiscard]] std::vector<TileClass> readTileClasses() const;
    /// For each tile, whether FrameStats::searched2d counts the tile.
    [[nodiscard]] std::vector<bool> readSearchedTiles() const;
    /// Weight of virtual objects in each output pixel. Empty without objects.
    [[nodiscard]] std::vector<float> readShownObjects() const;
    /// Output picture as RGBA8, first row first.
    [[nodiscard]] std::vector<std::uint8_t> readImage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Dense 2-D flow between two pictures of the same size and any format, for evaluation and tests.
/// Runs only the flow step. Returns x, y interleaved for each pixel p: a(p) looks like b(p + flow).
[[nodiscard]] std::vector<float> flowBetween(const ImageView& a, const ImageView& b);

}  // namespace mfar
