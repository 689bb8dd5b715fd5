#include "pipeline/slices/traced_pictures.h"

#include "pipeline/render/sampling_order.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mfar {
namespace {

// With TracedPolicy::soon, a moving camera gets a new picture at this share of the limits. The
// new picture inherits the light of the previous one.
constexpr double kSoon = 0.75;
// The next picture is discarded if the camera returns to within this share of the change that
// started the picture.
constexpr double kBack = 0.5;
// If the view has changed by this multiple of the limits, a noisy new picture is better than the
// shown picture.
constexpr double kHopeless = 3;
// Refining the shown picture is worth a new conversion if the number of samples has grown by this
// factor, because the error is then halved.
constexpr int kSamplesRatio = 4;
// The camera rests if it moves by less than kRestPixels in kRestLooks calls of look(). The picture
// of a camera at rest should not be warped: if the shown picture is off by more than
// kElsewherePixels, a new picture is begun.
constexpr double kRestPixels = 0.1, kElsewherePixels = 0.2;
constexpr int kRestLooks = 10;
// Upper limits of the weight [samples] of an earlier picture's light. The second limit is used if
// the lighting has changed; it is low, so that new samples soon outweigh the old light.
constexpr float kMostCarried = 64, kMostCarriedElsewhere = 4;
constexpr int kLookTurn = 1;

}  // namespace

TracedStep nextStep(std::optional<double> sinceShown, std::optional<double> sinceNext,
                    double renewed) {
    if (!sinceNext)
        return sinceShown && *sinceShown < renewed ? TracedStep::Refine : TracedStep::Start;
    // The first picture is always finished, even if the camera moves away: it is better than no
    // picture.
    if (!sinceShown) return TracedStep::Continue;
    if (*sinceShown < kBack * renewed) return TracedStep::Drop;
    return *sinceNext >= 1 && *sinceNext > *sinceShown ? TracedStep::Start : TracedStep::Continue;
}

TracedPictures::TracedPictures(const SliceOptions& slices, const TracedPolicy& policy,
                               std::shared_ptr<FilmMemory> memory)
    : slices_(slices), policy_(policy), memory_(std::move(memory)),
      pictures_{Picture(slices), Picture(slices)} {}

// The change of the view since a picture's view. Empty if the picture is out of date, because the
// objects or the lighting changed. For a picture in progress a change of the lighting is ignored:
// if the lighting changed all the time, no picture would ever be finished.
std::optional<double> TracedPictures::changeSince(const Picture& picture) const {
    const bool isShown = &picture == &pictures_[shown_];
    if (!picture.scene || picture.scene->objects != scene_->objects ||
        (isShown && picture.scene->light != scene_->light))
        return {};
    return viewChange(picture.view, now_, scene_->balls, policy_.limits);
}

void TracedPictures::watchRest() {
    if (pixelChange(restsAt_, now_, scene_->balls) < kRestPixels) {
        restLooks_ = std::min(restLooks_ + 1, kRestLooks);
    } else {
        restsAt_ = now_;
        restLooks_ = 0;
    }
}

TracedStep TracedPictures::chosenStep() const {
    const std::optional<double> sinceShown = changeSince(pictures_[shown_]);
    const bool rests = restLooks_ == kRestLooks;
    const bool hasBegun = hasNext_ && !toBegin_;
    if (hasBegun && nextRests_ && rests) return TracedStep::Continue;
    const bool isElsewhere =
        sinceShown && pixelChange(pictures_[shown_].view, now_, scene_->balls) > kElsewherePixels;
    const Picture& shown = pictures_[shown_];
    if (!hasBegun && rests && (isElsewhere || (shown.wasShown && !shown.rests)))
        return TracedStep::Start;
    const TracedStep step =
        nextStep(sinceShown, hasBegun ? changeSince(pictures_[1 - shown_]) : std::nullopt,
                 policy_.soon ? kSoon : 1);
    // If the shown picture still serves but has few samples, a new picture could not inherit light
    // from it.
    const bool serves = sinceShown && *sinceShown < 1;
    if (step == TracedStep::Start && !hasBegun && serves && shown.slices.samples() == 0)
        return TracedStep::Refine;
    return step;
}

void TracedPictures::look(const RenderView& now, const RenderView& predicted, Timestamp time) {
    now_ = now;
    if (!scene_) return;
    watchRest();
    const bool rests = restLooks_ == kRestLooks;
    switch (chosenStep()) {
    case TracedStep::Start:
        hasNext_ = toBegin_ = true;
        nextRests_ = rests;
        wanted_ = rests ? now : predicted;
        chosen_ = time;
        break;
    case TracedStep::Refine:
    case TracedStep::Drop: hasNext_ = toBegin_ = false; break;
    case TracedStep::Continue: break;
    }
}

// Away from objects the light on the real surface is smooth. While the camera moves, samples in a
// quarter of the pixels suffice there.
Slices::Density TracedPictures::densityOf(const PixelRect& tile, const Picture& picture,
                                          const PixelRect& objects) const {
    if (!common(tile, objects).empty()) return Slices::Density::Full;
    if (picture.history && pictures_[shown_].scene->light == picture.scene->light &&
        showsNothing(tile, picture.view))
        return Slices::Density::None;
    return picture.rests || !policy_.filter ? Slices::Density::Full : Slices::Density::Quarter;
}

// Whether the shown picture shows neither objects nor changed light around this tile.
bool TracedPictures::showsNothing(const PixelRect& tile, const RenderView& view) const {
    const Eigen::Vector2f middle(0.5F * static_cast<float>(tile.x0 + tile.x1 - 1),
                                 0.5F * static_cast<float>(tile.y0 + tile.y1 - 1));
    const auto point = scene_->tracer->catcherAt(view, middle);
    if (!point) return false;
    const RenderView& before = pictures_[shown_].view;
    const Eigen::Vector3d there = before.T_world_camera.inverse() * point->cast<double>();
    return there.z() > 0 &&
           pictures_[shown_].touched.isFarFrom(before.camera.project(there.hnormalized()));
}

bool TracedPictures::toBegin() const {
    return toBegin_ && pictures_[0].portions == 0 && pictures_[1].portions == 0;
}

// While the camera moves, a picture takes all blocks of a tile at the objects and one block of any
// other tile. Two pictures exist at the same time.
void TracedPictures::provide(RenderedPicture& out) {
    const auto blocksOf = [](const PixelRect& r, std::size_t pixels) {
        if (r.empty()) return std::size_t{0};
        return static_cast<std::size_t>(r.x1 - r.x0) * static_cast<std::size_t>(r.y1 - r.y0) /
               pixels;
    };
    const PixelRect objects = scene_->tracer->objectBounds(wanted_);
    const PixelRect traced = scene_->tracer->bounds(wanted_);
    memory_->provide(
        2 * (blocksOf(objects, Film::kBlockPixels) + blocksOf(traced, sampling::kTilePixels)));
    resolver_.reserve(wanted_.camera.size, policy_.filter, out);
    providedFor_ = scene_;
}

void TracedPictures::begin() {
    Picture& picture = pictures_[1 - shown_];
    picture.scene = scene_;
    picture.view = wanted_;
    picture.chosen = chosen_;
    picture.rests = nextRests_;
    picture.shownSamples = picture.shownTurns = 0;
    picture.wasShown = picture.counted = false;
    picture.history.reset();
    const Picture& shown = pictures_[shown_];
    if (policy_.history && shown.scene && shown.scene->objects == scene_->objects)
        picture.history.emplace(scene_->tracer->historyOf(
            *shown.film, shown.view,
            shown.scene->light == scene_->light ? kMostCarried : kMostCarriedElsewhere));
    if (!picture.film || !(picture.film->size() == wanted_.camera.size))
        picture.film = std::make_unique<Film>(wanted_.camera.size, memory_);
    picture.traced = scene_->tracer->bounds(wanted_);
    picture.film->begin();
    const PixelRect objects = scene_->tracer->objectBounds(wanted_);
    picture.slices.begin(picture.traced, wanted_.camera.size,
                         [&](const PixelRect& tile) { return densityOf(tile, picture, objects); });
    picture.touched.clear();
    toBegin_ = false;
}

TracedPictures::Portion TracedPictures::next(std::int64_t mostSamples) {
    Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || toShow()) return {};
    Portion out{picture.slices.next(mostSamples), working()};
    if (!out.slice.pixels.empty()) ++picture.portions;
    return out;
}

void TracedPictures::trace(const Portion& portion) {
    Picture& picture = pictures_[portion.picture];
    picture.scene->tracer->trace(picture.view, portion.slice.pixels, portion.slice.samples,
                                 *picture.film, picture.history ? &*picture.history : nullptr);
}

// While the camera rests, only samples of the pixel itself count, because carried light lacks edges
// and textures.
PixelState TracedPictures::Picture::state(std::uint32_t pixel, const Exposure& exposure) const {
    const KnownLight known = rests ? KnownLight{} : film->known(pixel);
    return {film->error(pixel, exposure),
            std::max(std::min(known.firstCount, known.secondCount),
                     static_cast<float>(film->samples(pixel))),
            film->isUntouched(pixel)};
}

void TracedPictures::done(const Portion& portion, const Exposure& exposure) {
    Picture& picture = pictures_[portion.picture];
    --picture.portions;
    picture.slices.done(portion.slice,
                        [&](std::uint32_t pixel) { return picture.state(pixel, exposure); });
}

int TracedPictures::leastSamples(const Picture& picture) const {
    if (picture.wasShown) return std::max(kSamplesRatio * picture.shownSamples, 1);
    const Picture& shown = pictures_[shown_];
    if (!shown.scene || shown.scene->objects != picture.scene->objects ||
        viewChange(shown.view, now_, scene_->balls, policy_.limits) >= kHopeless)
        return 1;
    // While the camera rests, the new picture must have at least as many samples as the shown one.
    return nextRests_ ? std::max(policy_.samplesToReplace, shown.shownSamples)
                      : policy_.samplesToReplace;
}

bool TracedPictures::toShow() const {
    const Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || !picture.slices.turnComplete()) return false;
    // The picture that will be replaced must not have outstanding portions.
    if (pictures_[1 - working()].portions > 0) return false;
    if (picture.slices.finished()) return !picture.counted;
    if (isSparse(picture)) return picture.slices.turns() > std::max(picture.shownTurns, kLookTurn);
    return picture.slices.samples() >= leastSamples(picture);
}

// While the camera moves, a picture with few samples and filtered light is better than a picture of
// another view or no picture.
bool TracedPictures::isSparse(const Picture& picture) const {
    if (picture.rests || !policy_.filter || picture.slices.samples() > 0) return false;
    const Picture& shown = pictures_[shown_];
    return &picture == &shown || !shown.scene || (policy_.soon && picture.history);
}

void TracedPictures::beginShow(const Exposure& exposure, RenderedPicture& out) {
    const Picture& picture = pictures_[working()];
    resolver_.begin(*picture.film, picture.view, picture.traced, exposure, policy_.filter, out,
                    picture.film.get(), !picture.rests);
}

void TracedPictures::endShow(RenderedPicture& out) {
    Picture& picture = pictures_[working()];
    out.scene = picture.scene->source;
    out.mirrors = picture.scene->tracer->mirrorLight();
    picture.touched.set(out);
    picture.shownSamples = picture.slices.samples();
    picture.shownTurns = picture.slices.turns();
    picture.wasShown = true;
    if (picture.slices.finished()) {
        picture.counted = true;
        ++finished_;
    }
    if (!hasNext_) return;
    pictures_[shown_].scene.reset();
    shown_ = 1 - shown_;
    hasNext_ = false;
}

bool TracedPictures::settled() const {
    const Picture& picture = pictures_[working()];
    return !toBegin_ && (!picture.scene || (picture.slices.finished() && picture.counted));
}

double TracedPictures::progress() const {
    const Picture& picture = pictures_[working()];
    return picture.scene && !toBegin_ ? picture.slices.progress() : 1;
}

std::size_t TracedPictures::pixels() const {
    return pictures_[working()].slices.pixels();
}

std::optional<Timestamp> TracedPictures::shownSince() const {
    const Picture& shown = pictures_[shown_];
    return shown.scene && shown.wasShown ? std::optional(shown.chosen) : std::nullopt;
}

}  // namespace mfar
