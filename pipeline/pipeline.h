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
    /// Output size; 0x0 = Pipeline::fullSize(). At a smaller size each pixel still averages
    /// everything that the sensors saw of it.
    Size output;
    /// Keeps unchanged tiles. Off: every tile is computed in each frame.
    bool skipUnchanged = true;
    Flow2dOptions flow2d{};
    EpipolarOptions epipolar{};
    DepthOptions depth{};
    /// Measures the real scene's depth in the whole picture instead of only where a virtual object
    /// may be occluded: for evaluation and for the preview.
    bool depthEverywhere = false;
    SkipOptions skips{};
    /// The engine of each step. GLES steps need a current GL context; without GLES steps, neither
    /// setObjects() nor setScene() may be called.
    EngineChoice engines = EngineChoice::fromEnvironment();
    /// Number of host threads that share a step's work; 0: one per processor, at most four.
    int threads = 0;
};

/// The processing of a frame: video in, high-resolution picture out. The constructor allocates what
/// every frame needs. The epipolar search is created in a thread during the first picture with a
/// pose, at the latest with the first still that has one; depth measurement with the first object.
/// Lives on one thread; if a step runs on GLES, that is the GL thread with its context current.
/// GlError and, for options out of range, std::invalid_argument are thrown only by set-up.
class Pipeline {
public:
    Pipeline(const StereoRig& rig, const PipelineOptions& options);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes this still the reference of the following frames; all work per still happens here. Any
    /// format; another size than the rig's or an invalid view (requireSound()) throws
    /// std::invalid_argument. `pose` is the video camera's at the still's time: if the still and
    /// the frame have poses, the flow is searched along epipolar lines, otherwise in both
    /// dimensions.
    void setStill(const ImageView& still, Timestamp time, const std::optional<Pose>& pose = {});
    /// Time of the older still that is kept for areas that the newest does not show.
    [[nodiscard]] std::optional<Timestamp> secondStill() const;
    /// Forgets the stills: the upscaled video is shown until the next one.
    void dropStill();
    /// Computes one picture. Throws std::invalid_argument as setStill() does.
    const FrameResult& run(const ImageView& video, Timestamp time,
                           const std::optional<Pose>& pose = {});

    /// setMode() and setSkipUnchanged() take effect with the next run.
    void setMode(SuperResMode mode);
    void setSkipUnchanged(bool skip);
    /// Sets the filters that enlarge the video if the mode uses filters. Used from the next still
    /// on, when pictures change anyway; at once without a still. Null: the built-in filters.
    void setFilters(std::shared_ptr<const FilterBank> filters);
    /// Receives each matched still while filters enlarge the video; null: no listener. It must
    /// outlive this.
    void setMatchListener(MatchListener* listener);
    /// Imports cameras' memory without a copy; null: every picture is uploaded. It must outlive
    /// this.
    void setImporter(PlaneImporter* importer);
    /// Why zero-copy import failed; returned once.
    [[nodiscard]] std::optional<std::string> takeImportFault();
    /// Affects drawing from the next run on; allocates nothing. Throws std::invalid_argument for
    /// settings out of range.
    void setQuality(const Quality& quality);
    /// The next run draws every tile again.
    void redraw();
    /// Objects shown in frames with a pose, seen from it and occluded by nearer real surfaces. The
    /// first call with an object allocates what objects need.
    void setObjects(std::vector<VirtualObject> objects);
    /// As setObjects(), but path traced. After each frame the scene is adapted to the real
    /// surroundings: shadows fall onto the measured surface and, with `light`, the light is
    /// estimated from the video. The first call with an object and calls with other options
    /// allocate. Throws as TracedLayer does.
    void setScene(Scene scene, const TracedLayerOptions& options,
                  std::optional<LightFollower> light = {});
    /// Video pixels in and around the virtual objects and their shadows in the last frame; empty if
    /// none is in view.
    [[nodiscard]] PixelRect objectsRegion() const;
    /// Counters of the path tracer and the warp; empty if they are not used.
    [[nodiscard]] std::optional<TracedLayerCounters> tracedCounters() const;
    /// Why a scene could not be shown; returned once.
    [[nodiscard]] std::optional<std::string> takeSceneError();

    [[nodiscard]] Size outputSize() const;
    /// Default output size: the still's width at the video's aspect ratio.
    [[nodiscard]] static Size fullSize(const StereoRig& rig);
    /// CPU-side stage times of the last run. With `measure` on, each stage waits until its work is
    /// done, so the times include GPU work; off (default), the frame path is not disturbed.
    [[nodiscard]] const std::vector<StageTime>& stageTimes() const;
    void setMeasure(bool measure);
    /// Waits until the last run's picture is ready where it is shown from: on the GPU or on the
    /// host.
    void finish(EngineKind shownFrom) const;

    /// The real scene's depth as of the last run that measured it. Throws std::bad_optional_access
    /// if there has been no object and `depthEverywhere` is off.
    [[nodiscard]] const InverseDepthField& inverseDepth() const;

    // Read-backs for tests, evaluation and the preview. They wait for the GPU.
    /// Numbers of the last run; FrameResult::stats is one frame behind to avoid waiting.
    [[nodiscard]] FrameStats readStats() const;
    /// Flow at every video pixel (x, y interleaved), bilinear between cells. With poses, a pixel
    /// gets its epipolar search's vector where the cells differ from it by at least half a pixel
    /// and have not left the lines. Empty without still.
    [[nodiscard]] std::vector<float> readFlow() const;
    /// Eq. 2 confidence at every video pixel, [0, 1]. Empty without still.
    [[nodiscard]] std::vector<float> readConfidence() const;
    /// Class of every tile, row-major, ceil(video / kTileSize) tiles.
    [[nodiscard]] std::vector<TileClass> readTileClasses() const;
    /// For each tile, whether FrameStats::searched2d counts it.
    [[nodiscard]] std::vector<bool> readSearchedTiles() const;
    /// Weight of virtual objects in every output pixel; empty without objects.
    [[nodiscard]] std::vector<float> readShownObjects() const;
    /// Output picture, RGBA8, row 0 first.
    [[nodiscard]] std::vector<std::uint8_t> readImage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Dense 2-D flow between two pictures of the same size, any format: only the flow stage, for
/// evaluation and tests. Returns x, y interleaved per pixel: a(p) looks like b(p + flow).
[[nodiscard]] std::vector<float> flowBetween(const ImageView& a, const ImageView& b);

}  // namespace mfar
