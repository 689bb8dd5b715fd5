#pragma once

#include "pipeline/render/picture_resolver.h"
#include "pipeline/slices/picture_coarseness.h"
#include "pipeline/slices/picture_scene.h"
#include "pipeline/slices/rest_watch.h"
#include "pipeline/slices/slices.h"
#include "pipeline/slices/touched_tiles.h"
#include "pipeline/slices/traced_step.h"
#include "pipeline/slices/view_change.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

struct TracedPolicy {
    ViewLimits limits;
    /// Samples per pixel that the next picture needs to replace the shown picture. Fewer suffice if
    /// the shown picture has other objects or a very different view, or if `soon` permits it. If
    /// the camera rests, the next picture also needs as many as the shown picture, or fewer if that
    /// has a lower resolution. Four filtered samples gave root mean square errors of 3.2 grey
    /// levels (of 255) on one scene and 4.4 on another; 16 unfiltered samples gave 3.3 and 3.1.
    int samplesToReplace = 4;
    bool filter = true;   ///< true: noise is filtered when a picture is converted to be shown
    bool history = true;  ///< true: a new picture begins with the light of the shown picture
    /// True: the next picture begins when viewChange() since the shown picture reaches kSoon, which
    /// is below 1. If it reuses the shown picture's light, `filter` is true and the camera moves,
    /// it can also be shown before every pixel has a sample. False: the next picture begins when
    /// viewChange() reaches 1. A caller that shows the colours of the picture, and not just its
    /// light, must set `soon` to false.
    bool soon = true;
    /// While the camera moves, a picture should be shown within about this time after its start
    /// [s], and within half of it if nothing is shown before. On a slow processor it is therefore
    /// traced at a lower resolution, at least a quarter of the camera's width and height. 0: always
    /// at the camera's resolution.
    double shownWithin = 0;
    bool operator==(const TracedPolicy&) const = default;
};

/// The two traced pictures: the shown picture, and the next picture, which will replace it. The
/// shown picture gets more samples as long as the view is within ViewLimits.
/// Only one thread at a time may call this class. The exceptions are trace() and, between
/// beginShow() and endShow(), PictureResolver::run() of resolver(): any number of threads may call
/// them, also while another thread calls another function. begin() and beginShow() never run during
/// trace(), because toBegin() and toShow() are false as long as a portion is traced.
class TracedPictures {
public:
    /// `memory` is for the films. Throws std::invalid_argument if a slice option is out of range.
    TracedPictures(const SliceOptions& slices, const TracedPolicy& policy,
                   std::shared_ptr<FilmMemory> memory = Film::makeMemory());

    void setScene(std::shared_ptr<const PictureScene> scene) { scene_ = std::move(scene); }
    [[nodiscard]] const PictureScene* scene() const { return scene_.get(); }
    [[nodiscard]] const std::shared_ptr<const PictureScene>& shownScene() const {
        return pictures_[shown_].scene;
    }

    /// Reports the camera's view `now`. A new picture gets the view `predicted`, or the view `now`
    /// if the camera rests. While objects move, new pictures follow each other without end, and
    /// each contains the objects as they will be when the picture is shown.
    void look(const RenderView& now, const RenderView& predicted, Timestamp time);

    /// Reports the processor time that the caller has. With TracedPolicy::shownWithin, the
    /// resolution depends on it.
    void setBudget(const FrameBudget& budget) { coarseness_.setBudget(budget); }

    /// True if begin() must be called. Until then next() returns no pixels.
    [[nodiscard]] bool toBegin() const;
    void begin();
    /// True if provide() should be called before begin().
    [[nodiscard]] bool lacksMemory() const { return toBegin_ && scene_ && providedFor_ != scene_; }
    /// Provides the memory for pictures of a scene and for `out`, so that the first samples do not
    /// wait for the kernel.
    void provide(RenderedPicture& out);

    /// The next portion of the picture in progress. If it has no pixels, there is nothing to trace
    /// now.
    struct Portion {
        Slice slice;
        std::size_t picture = 0;
    };
    [[nodiscard]] Portion next(std::int64_t mostSamples);
    void trace(const Portion& portion);
    /// `ms`: processor time of trace().
    void done(const Portion& portion, const Exposure& exposure, double ms);

    /// True if the picture in progress should be shown now: it is complete enough, and most of the
    /// time is spent on tracing, not on showing.
    [[nodiscard]] bool toShow() const;
    /// Begins to convert the picture in progress to `out`. The caller then lets resolver() do the
    /// work in portions. The caller must not call next() until resolver().complete() is true and
    /// endShow() was called.
    void beginShow(const Exposure& exposure, RenderedPicture& out);
    [[nodiscard]] PictureResolver& resolver() { return resolver_; }
    /// `ms`: processor time of the conversion.
    void endShow(RenderedPicture& out, double ms);

    /// True if the last turn of the picture in progress is complete; see Slices::turnComplete().
    [[nodiscard]] bool turnComplete() const { return pictures_[working()].slices.turnComplete(); }
    /// True if nothing is left to do while the camera rests.
    [[nodiscard]] bool settled() const;
    /// Finished share of the picture in progress, [0, 1] (see Slices); 1 if there is none.
    [[nodiscard]] double progress() const;
    [[nodiscard]] std::size_t pixels() const;
    [[nodiscard]] std::uint64_t finished() const { return finished_; }
    [[nodiscard]] std::optional<Timestamp> shownSince() const;

private:
    struct Picture {
        /// After this number of turns (passes over the pixels, see Slices), a quarter of the pixels
        /// has a sample. From then on, a picture may be shown.
        static constexpr int kQuarterTurn = 3;

        explicit Picture(const SliceOptions& slices) : slices(slices) {}

        std::shared_ptr<const PictureScene> scene;  // null if there is no picture
        RenderView wanted;                          // at the camera's resolution
        RenderView view;                            // the same view at the picture's resolution
        int coarseness = 0;
        bool isTrial = false;  // true until its speed is known
        double lookMs = 0;     // processor time of the rays through the pixels' centres
        Timestamp chosen;
        std::unique_ptr<Film> film;
        std::optional<LightHistory> history;
        PixelRect traced;
        TouchedTiles touched;
        Slices slices;
        int portions = 0;  // number of portions being traced
        // Values when the picture was last shown.
        int shownSamples = 0, shownTurns = 0;
        bool rests = false;                      // true if the camera rested when `view` was chosen
        bool wasShown = false, counted = false;  // `counted`: included in finished()

        /// True if the next picture can reuse the light. With samples in fewer than a quarter of
        /// the pixels, its shadows would have spots.
        [[nodiscard]] bool hasLight() const {
            return slices.turns() >= kQuarterTurn || (slices.pixels() > 0 && slices.finished());
        }
        [[nodiscard]] PixelState state(std::uint32_t pixel, const Exposure& exposure) const;
    };

    [[nodiscard]] std::size_t working() const { return hasNext_ ? 1 - shown_ : shown_; }
    [[nodiscard]] std::optional<double> changeSince(const Picture& picture) const;
    [[nodiscard]] double motionSince(const Picture& picture) const;
    [[nodiscard]] TracedStep chosenStep() const;
    [[nodiscard]] bool isTooCoarse(const Picture& shown) const;
    [[nodiscard]] int coarsenessOfNext(const RenderView& view) const;
    void endTrial(Picture& picture);
    [[nodiscard]] bool isNew() const;
    [[nodiscard]] double secondsSince(Timestamp begin) const;
    [[nodiscard]] std::shared_ptr<const PictureScene> sceneOfNext() const;
    [[nodiscard]] Slices::Density densityOf(const PixelRect& tile, const Picture& picture,
                                            const PixelRect& objects) const;
    [[nodiscard]] bool showsNothing(const PixelRect& tile, const Picture& picture) const;
    [[nodiscard]] bool isUrgent(const Picture& picture) const;
    [[nodiscard]] int leastSamples(const Picture& picture, bool urgent) const;
    [[nodiscard]] int leastTurns(const Picture& picture, bool urgent) const;
    [[nodiscard]] bool maybeSparse(const Picture& picture) const;

    const SliceOptions slices_;
    const TracedPolicy policy_;
    std::shared_ptr<const PictureScene> scene_;
    const std::shared_ptr<FilmMemory> memory_;
    std::shared_ptr<const PictureScene> providedFor_;
    std::array<Picture, 2> pictures_;
    PictureCoarseness coarseness_;
    PictureResolver resolver_;
    std::size_t shown_ = 0;
    bool hasNext_ = false, toBegin_ = false;
    bool nextRests_ = false;
    RenderView now_, wanted_;
    RestWatch rest_;
    Timestamp chosen_, time_;
    std::vector<RigidTransform> posesNow_;  // empty if no object moves
    double period_ = 0;  // time from the start of a picture until it is shown [s], smoothed
    std::uint64_t finished_ = 0;
    double convertedMs_ = 0;  // processor time of the last conversion [ms]
    double tracedMs_ = 0;     // processor time of tracing since then [ms]
};

}  // namespace mfar
