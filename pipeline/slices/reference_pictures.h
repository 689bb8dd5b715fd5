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

/// The next action for the reference pictures.
enum class ReferenceStep : unsigned char {
    Refine,    ///< the picture shown gets more samples
    Continue,  ///< the next picture gets more samples
    Start,     ///< a new next picture is begun; an unfinished one is discarded
    Drop,      ///< the next picture is discarded: the one shown serves again
};

/// `sinceShown`, `sinceNext`: viewChange() since the views of the two pictures; empty if the
/// picture does not exist or is of another scene. A next picture is begun at a change of `renewed`.
[[nodiscard]] ReferenceStep nextStep(std::optional<double> sinceShown,
                                     std::optional<double> sinceNext, double renewed);

struct ReferencePolicy {
    ViewLimits limits;
    /// Samples per pixel that a picture of another view must have to replace the one shown; fewer
    /// are enough if that one is of other objects or too far off. Four filtered samples are as good
    /// as 16 unfiltered ones (root mean square error 3.2 and 4.4 against 3.3 and 3.1 of 255 on two
    /// scenes).
    int samplesToReplace = 4;
    bool filter = true;   ///< smooth the noise
    bool history = true;  ///< carry light from the previous picture over to the next
    /// While the camera moves, begin the next picture long before the one shown has reached its
    /// limits, and show it before every pixel has a sample. For callers that use only the light of
    /// the picture.
    bool soon = true;
    bool operator==(const ReferencePolicy&) const = default;
};

/// The scene of a picture.
struct ReferenceScene {
    std::shared_ptr<const PathTracer> tracer;
    std::shared_ptr<const Scene> source;
    std::vector<ObjectBall> balls;
    std::uint64_t objects = 0, light = 0;  ///< version numbers of the objects and of the light
};

/// The two reference pictures: the one shown, which is refined while it serves, and the next one,
/// which will replace it. One caller at a time. Exceptions: any number of threads may call trace(),
/// and trace() and done() may run during begin() and between beginShow() and endShow().
class ReferencePictures {
public:
    /// Throws std::invalid_argument for slices out of range.
    ReferencePictures(const SliceOptions& slices, const ReferencePolicy& policy);

    void setScene(std::shared_ptr<const ReferenceScene> scene) { scene_ = std::move(scene); }
    [[nodiscard]] const ReferenceScene* scene() const { return scene_.get(); }
    /// Scene of the picture shown; null if there is none.
    [[nodiscard]] const std::shared_ptr<const ReferenceScene>& shownScene() const {
        return pictures_[shown_].scene;
    }

    /// Reports the camera's view `now`. If a picture is begun, it is for the view `predicted`; once
    /// the camera rests, a picture of exactly its view is begun.
    void look(const RenderView& now, const RenderView& predicted, Timestamp time);

    /// Whether begin() is due. Until then there is nothing to trace.
    [[nodiscard]] bool toBegin() const;
    void begin();

    /// The next portion of the picture in progress; done() needs the index `picture`. No pixels:
    /// nothing to trace now.
    struct Portion {
        Slice slice;
        std::size_t picture = 0;
    };
    [[nodiscard]] Portion next(std::int64_t mostSamples);
    /// May be called by any number of threads at once.
    void trace(const Portion& portion);
    void done(const Portion& portion, const Exposure& exposure);

    /// Whether the picture in progress is complete and should be shown.
    [[nodiscard]] bool toShow() const;
    /// Begins to make that picture, in portions of resolver(), until resolver().complete();
    /// meanwhile none of its samples are traced.
    void beginShow(const Exposure& exposure, RenderedPicture& out);
    [[nodiscard]] PictureResolver& resolver() { return resolver_; }
    void endShow(RenderedPicture& out);

    /// No portion of the picture in progress is outstanding, and every pixel has the same samples.
    [[nodiscard]] bool turnComplete() const { return pictures_[working()].slices.turnComplete(); }
    /// Nothing is left to do while the camera rests.
    [[nodiscard]] bool settled() const;
    /// Progress of the picture in progress, see Slices; 1 if there is none.
    [[nodiscard]] double progress() const;
    /// Number of pixels to trace in the current picture.
    [[nodiscard]] std::size_t pixels() const;
    [[nodiscard]] std::uint64_t finished() const { return finished_; }
    /// When the view of the picture shown was chosen.
    [[nodiscard]] std::optional<Timestamp> shownSince() const;

private:
    struct Picture {
        explicit Picture(const SliceOptions& slices) : slices(slices) {}

        std::shared_ptr<const ReferenceScene> scene;  // null: there is no picture
        RenderView view;
        Timestamp chosen;
        std::unique_ptr<Film> film;
        std::optional<LightHistory> history;  // from the picture shown before
        PixelRect traced;                     // the film is empty elsewhere
        TouchedTiles touched;
        Slices slices;
        int portions = 0;                        // outstanding
        int shownSamples = 0, shownTurns = 0;    // when it was shown last
        bool rests = false;                      // the camera rested when it was chosen
        bool wasShown = false, counted = false;  // counted: among the finished

        [[nodiscard]] PixelState state(std::uint32_t pixel, const Exposure& exposure) const;
    };

    [[nodiscard]] std::size_t working() const { return hasNext_ ? 1 - shown_ : shown_; }
    [[nodiscard]] std::optional<double> changeSince(const Picture& picture) const;
    [[nodiscard]] ReferenceStep chosenStep() const;
    void watchRest();
    [[nodiscard]] Slices::Density densityOf(const PixelRect& tile, const Picture& picture,
                                            const PixelRect& objects) const;
    [[nodiscard]] bool showsNothing(const PixelRect& tile, const RenderView& view) const;
    [[nodiscard]] int leastSamples(const Picture& picture) const;
    [[nodiscard]] bool isSparse(const Picture& picture) const;

    const SliceOptions slices_;
    const ReferencePolicy policy_;
    std::shared_ptr<const ReferenceScene> scene_;
    std::array<Picture, 2> pictures_;
    PictureResolver resolver_;
    std::size_t shown_ = 0;
    bool hasNext_ = false, toBegin_ = false;
    bool nextRests_ = false;  // the next picture is of a camera at rest
    RenderView now_, wanted_, restsAt_;
    int restLooks_ = 0;  // looks since the camera came to rest
    Timestamp chosen_;
    std::uint64_t finished_ = 0;
};

}  // namespace mfar
