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
    /// Size of the output picture; 0x0: Pipeline::fullSize(). If it is smaller than the still, each
    /// output pixel averages all still pixels of its area.
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

/// Makes a high-resolution picture from each video frame and the still. The constructor allocates
/// what every frame needs. The epipolar search is created by a thread that the first frame with a
/// pose starts, or at the latest by the first still that has a pose. Memory for depth measurement
/// is allocated with the first object.
/// All calls must come from one thread. If a step runs on GLES, this is the GL thread, and the GL
/// context must be current. GlError, and std::invalid_argument for options out of range, are thrown
/// only by functions that set something up.
class Pipeline {
public:
    Pipeline(const StereoRig& rig, const PipelineOptions& options);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes this still the reference of the following frames. All work that a new still needs is
    /// done in this call. The still may have any format. Throws std::invalid_argument if the
    /// still's size is not that of the rig's still camera, or if the view is invalid
    /// (requireSound()). `pose` is the pose of the video camera at the time of the still. If both
    /// the still and a frame have poses, the flow is searched along epipolar lines, otherwise in
    /// both dimensions.
    void setStill(const ImageView& still, Timestamp time, const std::optional<Pose>& pose = {});
    /// Time of the second, older still, which is kept for areas that the newest still does not
    /// show. Empty if no second still is kept.
    [[nodiscard]] std::optional<Timestamp> secondStill() const;
    /// Discards the stills. The enlarged video is shown until the next still.
    void dropStill();
    /// Computes one output picture. Throws std::invalid_argument like setStill().
    const FrameResult& run(const ImageView& video, Timestamp time,
                           const std::optional<Pose>& pose = {});

    /// setMode() and setSkipUnchanged() take effect with the next run.
    void setMode(SuperResMode mode);
    void setSkipUnchanged(bool skip);
    /// Sets the learned filters that enlarge the video. They are used from the next still on,
    /// because the picture changes then anyway. If there is no still, they are used at once. Null:
    /// the built-in filters.
    void setFilters(std::shared_ptr<const FilterBank> filters);
    /// Sets the object that receives each matched still while filters enlarge the video. Null: no
    /// listener. The listener must outlive the pipeline.
    void setMatchListener(MatchListener* listener);
    /// Sets the importer that gives the GPU access to camera memory without a copy. Null: every
    /// picture is uploaded. The importer must outlive the pipeline.
    void setImporter(PlaneImporter* importer);
    /// Returns why an import of camera memory without a copy failed. Each failure is returned once;
    /// empty: there was none.
    [[nodiscard]] std::optional<std::string> takeImportFault();
    /// Takes effect with the next run and allocates nothing. Throws std::invalid_argument if a
    /// setting is out of range.
    void setQuality(const Quality& quality);
    /// Makes the next run draw every tile again.
    void redraw();
    /// Sets the virtual objects that are shown in frames with a pose. They are drawn as seen from
    /// the frame's pose, and nearer real surfaces hide them. The first call with an object
    /// allocates memory.
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
    /// Returns why a scene could not be shown. Each failure is returned once; empty: there was
    /// none.
    [[nodiscard]] std::optional<std::string> takeSceneError();

    [[nodiscard]] Size outputSize() const;
    /// Default output size: as wide as the still, with the aspect ratio of the video.
    [[nodiscard]] static Size fullSize(const StereoRig& rig);
    /// Duration of each stage of the last run, measured on the CPU. After setMeasure(true), each
    /// stage waits until its work is done, so that the durations include GPU work. By default, no
    /// stage waits.
    [[nodiscard]] const std::vector<StageTime>& stageTimes() const;
    void setMeasure(bool measure);
    /// Waits until the last run's picture can be displayed from GPU memory (Gles) or from CPU
    /// memory (Simd).
    void finish(EngineKind shownFrom) const;

    /// The real scene's depth from the last run that measured it. Throws std::bad_optional_access
    /// if no object was ever set and `depthEverywhere` is off.
    [[nodiscard]] const InverseDepthField& inverseDepth() const;

    // Functions that read results back for tests, evaluation and the preview. They wait for the
    // GPU.
    /// Statistics of the last run. On a GPU, FrameResult::stats has those of the run before, so
    /// that run() need not wait.
    [[nodiscard]] FrameStats readStats() const;
    /// Flow of every video pixel (x, y interleaved), interpolated between cells. With poses, a
    /// pixel gets the vector that the epipolar search found for it instead, if the two vectors
    /// differ by at least half a pixel and the cells' vectors are not off the epipolar lines. Empty
    /// without a still.
    [[nodiscard]] std::vector<float> readFlow() const;
    /// Confidence (eq. 2) of every video pixel, [0, 1]. Empty without a still.
    [[nodiscard]] std::vector<float> readConfidence() const;
    /// Class of every tile, row-major, ceil(video / kTileSize) tiles.
    [[nodiscard]] std::vector<TileClass> readTileClasses() const;
    /// For each tile, whether FrameStats::searched2d counts the tile.
    [[nodiscard]] std::vector<bool> readSearchedTiles() const;
    /// How much virtual objects cover each output pixel, [0, 1]. Empty without objects.
    [[nodiscard]] std::vector<float> readShownObjects() const;
    /// Output picture as RGBA8, first row first.
    [[nodiscard]] std::vector<std::uint8_t> readImage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Dense 2-D flow from picture a to picture b, which have the same size and any format; for
/// evaluation and tests. Runs only the flow step. Returns x, y interleaved for each pixel p of a:
/// a(p) looks like b(p + flow).
[[nodiscard]] std::vector<float> flowBetween(const ImageView& a, const ImageView& b);

}  // namespace mfar
