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

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

struct PipelineOptions {
    SuperResMode mode = SuperResMode::Detail;
    /// Size of the output picture; 0x0 means Pipeline::fullSize(). For an output that is much
    /// smaller than the still, the still is reduced first, see stillFor().
    Size output;
    /// True: unchanged tiles keep their pixels. False: every tile is computed in each frame.
    bool skipUnchanged = true;
    Flow2dOptions flow2d{};
    EpipolarOptions epipolar{};
    DepthOptions depth{};
    /// True: depth is measured in the whole picture, for evaluation and the demo. False: it is
    /// measured only where a virtual object may be occluded.
    bool depthEverywhere = false;
    SkipOptions skips{};
    /// The engine of each step. A GL context must be current if a step uses GLES. For setObjects(),
    /// it must be current in any case.
    EngineChoice engines = EngineChoice::fromEnvironment();
    /// Number of CPU threads that share the work of a step. 0: one per processor, but at most four.
    int threads = 0;
};

/// Makes a high-resolution picture from each video frame and the still. The constructor allocates
/// the memory that every frame needs. The memory for the depth measurement is allocated when the
/// first virtual object is set. The epipolar search is created in a thread of its own, which starts
/// at the first still with a pose, or at the first frame with a pose if Quality::alongLines is true
/// and the mode is not Off. setStill() with a pose waits until it is created.
///
/// All calls must come from one thread. If a step runs on GLES, the GL context must be current in
/// this thread. Only functions that set something up throw GlError, or std::invalid_argument for
/// options out of range.
class Pipeline {
public:
    Pipeline(const StereoRig& rig, const PipelineOptions& options);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes this still the reference of the following frames, and does the work that a new still
    /// causes. The still may have any format. `pose` is the pose of the video camera at the time of
    /// the still. If the still and a frame have poses in the same world (Pose::world) and
    /// Quality::alongLines is true, their flow is searched along epipolar lines, otherwise in both
    /// dimensions. Throws std::invalid_argument if the still is invalid (requireSound()) or does
    /// not have the size of the rig's still camera.
    void setStill(const ImageView& still, Timestamp time, const std::optional<Pose>& pose = {});
    /// Time of the second still, or empty if there is none. The second still is older than the
    /// newest one and is shown in areas that the newest still does not show.
    [[nodiscard]] std::optional<Timestamp> secondStill() const;
    void dropStill();
    /// Computes one output picture. Throws std::invalid_argument if `video` does not have the size
    /// of the rig's video camera or is invalid (requireSound()).
    const FrameResult& run(const ImageView& video, Timestamp time,
                           const std::optional<Pose>& pose = {});

    /// setMode() and setSkipUnchanged() take effect with the next run.
    void setMode(SuperResMode mode);
    void setSkipUnchanged(bool skip);
    /// Sets the learned filters that enlarge the video. Null: the built-in filters. The new filters
    /// are used from the next still on, because a new still changes the picture anyway. If there is
    /// no still, they are used at once.
    void setFilters(std::shared_ptr<const FilterBank> filters);
    /// Sets the listener. It receives each still twice: after the first match, and when a new still
    /// replaces it. It is called only while learned filters enlarge the video. Null: no listener.
    /// The listener must outlive the pipeline.
    void setMatchListener(MatchListener* listener);
    /// Sets the importer that lets the GPU read camera memory without a copy. Null: every picture
    /// is uploaded. The importer must outlive the pipeline.
    void setImporter(PlaneImporter* importer);
    /// See Engine::takeImportFault().
    [[nodiscard]] std::optional<std::string> takeImportFault();
    /// Takes effect with the next run, in the tiles that are drawn. Allocates nothing, except for a
    /// change to mode Blend. Throws std::invalid_argument if a setting is out of range.
    void setQuality(const Quality& quality);
    /// Makes the next run draw every tile again.
    void redraw();
    /// Sets the virtual objects, and removes a scene of setScene(). The objects are shown in frames
    /// with a pose, and nearer real surfaces hide them. The first call with an object and the first
    /// call after setScene() allocate memory.
    void setObjects(std::vector<VirtualObject> objects);
    /// Sets a path-traced scene, and removes the objects of setObjects(). After each frame with a
    /// pose in which an object is in view, the scene is adapted to the real surroundings: shadows
    /// fall onto the measured surface. With `light`, the light is also estimated from the video. A
    /// scene without objects removes the last scene. Memory is allocated by a call with an object
    /// if there was no path-traced scene before or if the options changed. Throws like TracedLayer.
    void setScene(Scene scene, const TracedLayerOptions& options,
                  std::optional<LightFollower> light = {});
    /// Returns a rectangle of video pixels that contains the virtual objects and their shadows in
    /// the last frame, with a margin. It is empty if no object is in view.
    [[nodiscard]] PixelRect objectsRegion() const;
    /// Counters of the path tracer and the warp. Empty if there is no path-traced scene.
    [[nodiscard]] std::optional<TracedLayerCounters> tracedCounters() const;
    /// See TracedLayer::takeError(). Empty if there is no path-traced scene.
    [[nodiscard]] std::optional<std::string> takeSceneError();
    /// Waits until the path tracer has finished the work that the last run() allowed, but at most
    /// this long. For frames that do not arrive in real time.
    void waitForTracer(std::chrono::milliseconds most) const;

    [[nodiscard]] Size outputSize() const;
    /// Default output size: as wide as the still, with the aspect ratio of the video.
    [[nodiscard]] static Size fullSize(const StereoRig& rig);
    /// Duration of each stage of the last run, measured on the CPU. By default, stages do not wait
    /// for the GPU. After setMeasure(true), each stage waits until its work is done, so that its
    /// duration includes the work of the GPU.
    [[nodiscard]] const std::vector<StageTime>& stageTimes() const;
    void setMeasure(bool measure);
    /// Waits until the last run's picture is complete and can be displayed, from GPU memory (Gles)
    /// or from CPU memory (Simd).
    void finish(EngineKind shownFrom) const;

    /// The real scene's depth, from the last run that measured it. Throws std::bad_optional_access
    /// if there was never an object and `depthEverywhere` is false.
    [[nodiscard]] const InverseDepthField& inverseDepth() const;

    // The functions below read results back, for tests, evaluation and the demo. They wait for
    // the GPU. With the GLES engine, some numbers in FrameResult::stats are those of the run before
    // the last one (see FrameStats); readStats() returns all numbers of the last run.
    [[nodiscard]] FrameStats readStats() const;
    /// Flow of every video pixel (x, y interleaved), interpolated between cells. If the flow was
    /// searched along epipolar lines, each pixel also has its own vector from this search.
    /// This vector replaces the interpolated one if the two differ by at least half a pixel, unless
    /// a moving object is at the pixel. The result is empty if there is no match with a still.
    [[nodiscard]] std::vector<float> readFlow() const;
    /// Confidence of every video pixel (eq. 2 of the paper, see docs/paper.md), [0, 1]. The result
    /// is empty if there is no match with a still.
    [[nodiscard]] std::vector<float> readConfidence() const;
    [[nodiscard]] std::vector<TileClass> readTileClasses() const;
    [[nodiscard]] std::vector<bool> readSearchedTiles() const;
    /// Share of each output pixel that virtual objects cover, [0, 1]. Without objects, the
    /// result is empty.
    [[nodiscard]] std::vector<float> readShownObjects() const;
    /// Output picture as RGBA8, first row first.
    [[nodiscard]] std::vector<std::uint8_t> readImage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns the dense 2-D flow from picture a to picture b, for evaluation and tests. The pictures
/// may have any format. Throws std::invalid_argument if a picture is invalid (requireSound()) or
/// smaller than 16x16 pixels, or if the sizes differ. Each pixel p of a has two successive numbers,
/// x and y: b shows at p + (x, y) what a shows at p. Needs a current GL context.
[[nodiscard]] std::vector<float> flowBetween(const ImageView& a, const ImageView& b);

}  // namespace mfar
