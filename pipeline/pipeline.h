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
    /// Output size; 0x0 = Pipeline::fullSize(). Of a smaller one every pixel still comes from all
    /// that the sensors saw of it.
    Size output;
    /// Leaves tiles alone that did not change. Off: every tile is computed each frame.
    bool skipUnchanged = true;
    Flow2dOptions flow2d{};
    EpipolarOptions epipolar{};
    DepthOptions depth{};
    /// Measures the real scene's depth in the whole picture, not only where a virtual object may be
    /// hidden: for evaluation and for the preview.
    bool depthEverywhere = false;
    SkipOptions skips{};
    /// Which engine does which step. GLES steps need a current GL context; without any, neither
    /// setObjects() nor setScene() may be called.
    EngineChoice engines = EngineChoice::fromEnvironment();
    int threads = 0;  ///< host threads that share a step's work; 0: one per processor, at most four
};

/// The whole flow of a frame: video in, high-resolution picture out. Allocates in the constructor
/// what every frame needs; what searches along lines in a thread beside the first picture with a
/// pose, at the latest with the first still that has one; what measures depth with the first
/// object. Lives on one thread; where a step runs on GLES, that is the GL thread with its context
/// current. Throws GlError and, for options out of range, std::invalid_argument from set-up only.
class Pipeline {
public:
    Pipeline(const StereoRig& rig, const PipelineOptions& options);
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;

    /// Makes this still the reference of the following frames; all per-still work happens here.
    /// Size must be the rig's, any format; another size or a view that is not sound
    /// (requireSound()) throws std::invalid_argument.
    /// `pose` of the video camera at the still's time: with it and a frame's the flow is sought
    /// along epipolar lines; without one of them it is sought in both dimensions.
    void setStill(const ImageView& still, Timestamp time, const std::optional<Pose>& pose = {});
    /// Time of the older still that is kept for what the newest does not show.
    [[nodiscard]] std::optional<Timestamp> secondStill() const;
    /// Forgets the stills: the upscaled video is shown until the next one.
    void dropStill();
    /// Computes one picture. Throws std::invalid_argument as setStill() does.
    const FrameResult& run(const ImageView& video, Timestamp time,
                           const std::optional<Pose>& pose = {});

    /// Both take effect with the next run.
    void setMode(SuperResMode mode);
    void setSkipUnchanged(bool skip);
    /// The video is enlarged by these, where it is by filters at all: from the next still on, so
    /// that pictures change when they change anyway; at once where there is no still. Null: by
    /// those that the product ships.
    void setFilters(std::shared_ptr<const FilterBank> filters);
    /// Receives each still that was matched, where the video is enlarged by filters; null: none. It
    /// must outlive this.
    void setMatchListener(MatchListener* listener);
    /// Reads cameras' memory without a copy; null: all is uploaded. It must outlive this.
    void setImporter(PlaneImporter* importer);
    /// Why zero-copy import failed; returned once.
    [[nodiscard]] std::optional<std::string> takeImportFault();
    /// Takes effect with the next run, in what that draws; allocates nothing. Throws
    /// std::invalid_argument for settings out of range.
    void setQuality(const Quality& quality);
    /// The next run draws everything anew.
    void redraw();
    /// Shown in frames with a pose, as seen from there and hidden behind what is nearer. The first
    /// call with any allocates what they need.
    void setObjects(std::vector<VirtualObject> objects);
    /// The same, path traced. After each frame the scene is kept as the real one around it is found
    /// to be: shadows fall onto the measured surface and, with `light`, light follows the video.
    /// The first call with any object allocates what it needs, as do later ones with other options.
    /// Throws as TracedLayer does.
    void setScene(Scene scene, const TracedLayerOptions& options,
                  std::optional<LightFollower> light = {});
    /// Video pixels in and around the virtual objects and their shadows in the last frame; empty
    /// without any in view.
    [[nodiscard]] PixelRect objectsRegion() const;
    /// Of the path tracer and the warp; nothing where none is used.
    [[nodiscard]] std::optional<TracedLayerCounters> tracedCounters() const;
    /// What was wrong with a scene that could not be shown, once.
    [[nodiscard]] std::optional<std::string> takeSceneError();

    [[nodiscard]] Size outputSize() const;
    /// Where no other size is asked for: the still's width at the video's aspect ratio.
    [[nodiscard]] static Size fullSize(const StereoRig& rig);
    /// CPU-side stage times of the last run. With `measure` on, each stage waits until its work is
    /// done and the times are those of the work; off (default), the frame path is not disturbed.
    [[nodiscard]] const std::vector<StageTime>& stageTimes() const;
    void setMeasure(bool measure);
    /// Waits until the last run's picture lies where it is shown from: on the GPU or on the host.
    void finish(EngineKind shownFrom) const;

    /// The real scene's depth as of the last run, where that measured it. Throws
    /// std::bad_optional_access without `depthEverywhere` as long as there was no object.
    [[nodiscard]] const InverseDepthField& inverseDepth() const;

    // Read-backs for tests, evaluation and the preview; they wait for the GPU.
    /// Numbers of the last run; FrameResult::stats is one frame behind, so that nothing waits.
    [[nodiscard]] FrameStats readStats() const;
    /// Flow at every video pixel (x, y interleaved), bilinear between cells; with poses as each
    /// pixel's epipolar search found it, where the cells do not confirm that to a pixel, unless
    /// they left the lines. Empty without still.
    [[nodiscard]] std::vector<float> readFlow() const;
    /// Eq. 2 confidence at every video pixel, [0, 1]. Empty without still.
    [[nodiscard]] std::vector<float> readConfidence() const;
    /// Class of every tile, row-major, ceil(video / kTileSize) tiles.
    [[nodiscard]] std::vector<TileClass> readTileClasses() const;
    /// Of every tile: FrameStats::searched2d counts it.
    [[nodiscard]] std::vector<bool> readSearchedTiles() const;
    /// Share of every output pixel that shows a virtual object; empty where there are none.
    [[nodiscard]] std::vector<float> readShownObjects() const;
    /// Output picture, RGBA8, row 0 first.
    [[nodiscard]] std::vector<std::uint8_t> readImage() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Dense 2-D flow between two pictures of the same size, any format: the flow stage alone, for
/// evaluation and tests. Returns x, y interleaved per pixel: a(p) looks like b(p + flow).
[[nodiscard]] std::vector<float> flowBetween(const ImageView& a, const ImageView& b);

}  // namespace mfar
