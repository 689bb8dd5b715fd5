#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/render/picture_resolver.h"
#include "pipeline/slices/slices.h"
#include "pipeline/slices/touched_tiles.h"
#include "pipeline/slices/view_change.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// The next action for the traced pictures. A traced picture is a rendering that the warp
/// shows from nearby poses.
enum class TracedStep : unsigned char {
    Refine,    ///< the shown picture gets more samples
    Continue,  ///< the next picture gets more samples
    Start,     ///< a new next picture is begun; an unfinished one is discarded
    Drop,      ///< the next picture is discarded, because the shown picture serves again
};

/// `sinceShown` and `sinceNext` are the results of viewChange() since the views of the shown and
/// the next picture. They are empty if the picture does not exist or shows another scene. A next
/// picture is begun if the change reaches `renewed`.
[[nodiscard]] TracedStep nextStep(std::optional<double> sinceShown, std::optional<double> sinceNext,
                                  double renewed);

struct TracedPolicy {
    ViewLimits limits;
    /// Samples per pixel that a picture of another view must have before it replaces the shown
    /// picture. Fewer samples suffice if the shown picture has other objects or its view is too far
    /// off. Four filtered samples are about as good as 16 unfiltered ones (root mean square errors
    /// on two scenes: 3.2 and 4.4 against 3.3 and 3.1 of 255).
    int samplesToReplace = 4;
    bool filter = true;   ///< smooth the noise
    bool history = true;  ///< use the previous picture's light for the next picture
    /// While the camera moves, begin the next picture long before the shown picture reaches its
    /// limits, and show the next picture before every pixel has a sample. For callers that use only
    /// the light of the picture.
    bool soon = true;
    bool operator==(const TracedPolicy&) const = default;
};

/// The scene of a picture with a search structure.
struct PictureScene {
    std::shared_ptr<const PathTracer> tracer;
    std::shared_ptr<const Scene> source;
    std::vector<ObjectBall> balls;
    std::uint64_t objects = 0, light = 0;  ///< versions of the objects and of the light
};

/// The two traced pictures: the shown picture, which gets more samples while it serves, and the
/// next picture, which will replace it.
/// Only one thread at a time may call it, with two exceptions. Any number of threads may call
/// trace() at once. trace() and done() may run during begin() and between beginShow() and
/// endShow().
class TracedPictures {
public:
    /// `memory` is for the films. Throws std::invalid_argument if a slice option is out of range.
    TracedPictures(const SliceOptions& slices, const TracedPolicy& policy,
                   std::shared_ptr<FilmMemory> memory = Film::makeMemory());

    void setScene(std::shared_ptr<const PictureScene> scene) { scene_ = std::move(scene); }
    [[nodiscard]] const PictureScene* scene() const { return scene_.get(); }
    /// Scene of the shown picture; null if there is no picture.
    [[nodiscard]] const std::shared_ptr<const PictureScene>& shownScene() const {
        return pictures_[shown_].scene;
    }

    /// Reports the camera's view `now`. A picture that is begun has the view `predicted`, or
    /// exactly the view `now` if the camera rests.
    void look(const RenderView& now, const RenderView& predicted, Timestamp time);

    /// Whether begin() must be called. Until then next() returns no pixels.
    [[nodiscard]] bool toBegin() const;
    void begin();
    /// Whether provide() should be called before begin().
    [[nodiscard]] bool lacksMemory() const { return toBegin_ && scene_ && providedFor_ != scene_; }
    /// Provides the memory for pictures of a scene and for `out`, so that the first samples do not
    /// wait for the kernel.
    void provide(RenderedPicture& out);

    /// The next portion of the picture in progress. `picture` is needed by done(). If there are no
    /// pixels, there is nothing to trace now.
    struct Portion {
        Slice slice;
        std::size_t picture = 0;
    };
    [[nodiscard]] Portion next(std::int64_t mostSamples);
    /// Any number of threads may call it at once.
    void trace(const Portion& portion);
    void done(const Portion& portion, const Exposure& exposure);

    /// Whether the picture in progress is complete enough to be shown now.
    [[nodiscard]] bool toShow() const;
    /// Begins to convert the picture in progress to `out`, in portions of resolver(). None of the
    /// picture's samples are traced until resolver().complete() and endShow().
    void beginShow(const Exposure& exposure, RenderedPicture& out);
    [[nodiscard]] PictureResolver& resolver() { return resolver_; }
    void endShow(RenderedPicture& out);

    /// Whether no portion of the picture in progress is outstanding and every pixel has the same
    /// number of samples.
    [[nodiscard]] bool turnComplete() const { return pictures_[working()].slices.turnComplete(); }
    /// Whether there is nothing left to do while the camera rests.
    [[nodiscard]] bool settled() const;
    /// Progress of the picture in progress (see Slices); 1 if there is no picture in progress.
    [[nodiscard]] double progress() const;
    /// Number of pixels that are traced in the picture in progress.
    [[nodiscard]] std::size_t pixels() const;
    [[nodiscard]] std::uint64_t finished() const { return finished_; }
    /// Time when the view of the shown picture was chosen.
    [[nodiscard]] std::optional<Timestamp> shownSince() const;

private:
    struct Picture {
        explicit Picture(const SliceOptions& slices) : slices(slices) {}

        std::shared_ptr<const PictureScene> scene;  // null: there is no picture
        RenderView view;
        Timestamp chosen;
        std::unique_ptr<Film> film;
        std::optional<LightHistory> history;  // light of the previously shown picture
        PixelRect traced;                     // the film is empty outside this rectangle
        TouchedTiles touched;
        Slices slices;
        int portions = 0;                        // number of outstanding portions
        int shownSamples = 0, shownTurns = 0;    // values when it was last shown
        bool rests = false;                      // the camera rested when the view was chosen
        bool wasShown = false, counted = false;  // counted: included in finished()

        [[nodiscard]] PixelState state(std::uint32_t pixel, const Exposure& exposure) const;
    };

    [[nodiscard]] std::size_t working() const { return hasNext_ ? 1 - shown_ : shown_; }
    [[nodiscard]] std::optional<double> changeSince(const Picture& picture) const;
    [[nodiscard]] TracedStep chosenStep() const;
    void watchRest();
    [[nodiscard]] Slices::Density densityOf(const PixelRect& tile, const Picture& picture,
                                            const PixelRect& objects) const;
    [[nodiscard]] bool showsNothing(const PixelRect& tile, const RenderView& view) const;
    [[nodiscard]] int leastSamples(const Picture& picture) const;
    [[nodiscard]] bool isSparse(const Picture& picture) const;

    const SliceOptions slices_;
    const TracedPolicy policy_;
    std::shared_ptr<const PictureScene> scene_;
    const std::shared_ptr<FilmMemory> memory_;
    std::shared_ptr<const PictureScene> providedFor_;  // the scene of the last provide()
    std::array<Picture, 2> pictures_;
    PictureResolver resolver_;
    std::size_t shown_ = 0;
    bool hasNext_ = false, toBegin_ = false;
    bool nextRests_ = false;  // the next picture is for a camera at rest
    RenderView now_, wanted_, restsAt_;
    int restLooks_ = 0;  // calls of look() since the camera came to rest
    Timestamp chosen_;
    std::uint64_t finished_ = 0;
};

}  // namespace mfar
