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

/// What is to be done about a reference picture.
enum class ReferenceStep : unsigned char {
    Refine,    ///< the picture shown gets more samples
    Continue,  ///< the next one does
    Start,     ///< a next one is begun, in place of what there is of it
    Drop,      ///< the next one is given up: the one shown serves again
};

/// The changes since the pictures' views, as of viewChange(); nothing: there is no such picture, or
/// it is of another scene.
/// A next picture is begun at `renewed` of the limit.
[[nodiscard]] ReferenceStep nextStep(std::optional<double> sinceShown,
                                     std::optional<double> sinceNext, double renewed);

struct ReferencePolicy {
    ViewLimits limits;
    /// A picture of another view takes the shown one's place with so many samples, unless that is
    /// of other objects or hopelessly far off. Four that are filtered are as good as 16 that are
    /// not (root mean square error 3.2 and 4.4 against 3.3 and 3.1 of 255 on two scenes).
    int samplesToReplace = 4;
    bool filter = true;   ///< of noise
    bool history = true;  ///< light of the picture before is carried over to the next
    /// While the camera moves, the next picture begins long before the one shown has reached its
    /// limits, and is shown before every pixel has a sample. For what takes light alone from it.
    bool soon = true;
    bool operator==(const ReferencePolicy&) const = default;
};

/// The scene a picture is of.
struct ReferenceScene {
    std::shared_ptr<const PathTracer> tracer;
    std::shared_ptr<const Scene> source;
    std::vector<ObjectBall> balls;
    std::uint64_t objects = 0, light = 0;  ///< numbers that change with them
};

/// The two reference pictures: the one shown, which is refined while it serves, and the next one,
/// which takes its place. One caller at a time, but trace() may be called by any number, and
/// trace() and done() alone during begin() and from beginShow() to endShow().
class ReferencePictures {
public:
    /// Throws std::invalid_argument for slices out of range.
    ReferencePictures(const SliceOptions& slices, const ReferencePolicy& policy);

    void setScene(std::shared_ptr<const ReferenceScene> scene) { scene_ = std::move(scene); }
    [[nodiscard]] const ReferenceScene* scene() const { return scene_.get(); }
    /// Of the picture shown; none: there is none.
    [[nodiscard]] const std::shared_ptr<const ReferenceScene>& shownScene() const {
        return pictures_[shown_].scene;
    }

    /// The camera is at `now`; a picture that is begun because of it is made for `predicted`.
    /// One that has come to rest gets a picture of its very view.
    void look(const RenderView& now, const RenderView& predicted, Timestamp time);

    /// Whether begin() is due. Then there is nothing to trace.
    [[nodiscard]] bool toBegin() const;
    void begin();

    /// The next portion of the picture in the making, which is number `picture` until it is done.
    /// No pixels: nothing to trace now.
    struct Portion {
        Slice slice;
        std::size_t picture = 0;
    };
    [[nodiscard]] Portion next(std::int64_t mostSamples);
    /// Any number of threads may be in here.
    void trace(const Portion& portion);
    void done(const Portion& portion, const Exposure& exposure);

    /// Whether the picture in the making is complete and should be shown.
    [[nodiscard]] bool toShow() const;
    /// Then it is made in portions, until that is complete; meanwhile nothing of it is traced.
    void beginShow(const Exposure& exposure, RenderedPicture& out);
    [[nodiscard]] PictureResolver& resolver() { return resolver_; }
    void endShow(RenderedPicture& out);

    /// No portion of the picture in the making is out, and every pixel has the same samples.
    [[nodiscard]] bool turnComplete() const { return pictures_[working()].slices.turnComplete(); }
    /// Nothing is to be done for a camera that rests.
    [[nodiscard]] bool settled() const;
    /// Of the picture in the making, as of Slices; 1 without one.
    [[nodiscard]] double progress() const;
    /// Pixels that a picture has, as far as is known.
    [[nodiscard]] std::size_t pixels() const;
    [[nodiscard]] std::uint64_t finished() const { return finished_; }
    /// When the view of the picture shown was chosen.
    [[nodiscard]] std::optional<Timestamp> shownSince() const;

private:
    struct Picture {
        explicit Picture(const SliceOptions& slices) : slices(slices) {}

        std::shared_ptr<const ReferenceScene> scene;  // none: there is no picture
        RenderView view;
        Timestamp chosen;
        std::unique_ptr<Film> film;
        std::optional<LightHistory> history;  // of the picture shown before
        PixelRect traced;                     // there is nothing elsewhere in the film
        TouchedTiles touched;
        Slices slices;
        int portions = 0;                        // out
        int shownSamples = 0, shownTurns = 0;    // when it was shown last
        bool rests = false;                      // it is of a camera at rest
        bool wasShown = false, counted = false;  // among the finished

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
    bool nextRests_ = false;  // the next one is of a camera at rest
    RenderView now_, wanted_, restsAt_;
    int restLooks_ = 0;  // since it is there
    Timestamp chosen_;
    std::uint64_t finished_ = 0;
};

}  // namespace mfar
