#include "pipeline/slices/traced_pictures.h"

#include "pipeline/render/sampling_order.h"
#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mfar {
namespace {

// From this multiple of ViewLimits on, a noisy new picture is better than the shown picture.
constexpr double kHopeless = 3;
// The shown picture is converted again when its number of samples has grown by this factor.
constexpr int kSamplesRatio = 2;
// A conversion takes about as long as sampling a tenth to a half of the pixels. So the next
// conversion begins only after tracing took this many times as long as the last conversion. While
// the camera moves, factors of 2.5 to 4 gave the best pictures; 6 and 0 were 0.2 dB worse.
constexpr double kTracedPerConverted = 4;
// If there is no usable picture yet and sampling has taken this time [s], a picture with samples in
// one pixel of 16 may be shown, a turn before Picture::kQuarterTurn. If the camera rests, it may
// not, because a picture for the camera at rest follows, which could not reuse so few samples.
constexpr double kLongWait = 0.25;
// Upper limits of the weight with which the light of an earlier picture counts in a new one
// [samples]. The second limit applies after a change of lighting. It is low, so that new samples
// soon outweigh the old light.
constexpr float kMostCarried = 64, kMostCarriedElsewhere = 4;
// Light on the shadow catcher is traced again if moving objects may have changed it by more than
// this share (see MovedLight::diffuseChange()).
constexpr float kVisible = 0.003F;
constexpr double kFarthestAhead = 0.5;  // longest prediction of the motion of objects [s]
constexpr double kPeriodShare = 0.3;

}  // namespace

TracedPictures::TracedPictures(const SliceOptions& slices, const TracedPolicy& policy,
                               std::shared_ptr<FilmMemory> memory)
    : slices_(slices), policy_(policy), memory_(std::move(memory)),
      pictures_{Picture(slices), Picture(slices)}, coarseness_(policy.shownWithin) {}

// Far from objects, the light on real surfaces is smooth. While the camera moves, samples in a
// quarter of the pixels suffice there.
Slices::Density TracedPictures::densityOf(const PixelRect& tile, const Picture& picture,
                                          const PixelRect& objects) const {
    if (!common(tile, objects).empty()) return Slices::Density::Full;
    if (picture.history && pictures_[shown_].scene->light == picture.scene->light &&
        showsNothing(tile, picture))
        return Slices::Density::None;
    return picture.rests || !policy_.filter ? Slices::Density::Full : Slices::Density::Quarter;
}

bool TracedPictures::showsNothing(const PixelRect& tile, const Picture& picture) const {
    const Eigen::Vector2f middle(0.5F * static_cast<float>(tile.x0 + tile.x1 - 1),
                                 0.5F * static_cast<float>(tile.y0 + tile.y1 - 1));
    const auto point = picture.scene->tracer->catcherAt(picture.view, middle);
    if (!point) return false;
    const MovedLight* moved = picture.history->moved();
    if (moved != nullptr && moved->diffuseChange(point->position, point->normal) > kVisible)
        return false;
    const RenderView& before = pictures_[shown_].view;
    const Eigen::Vector3d there = before.T_world_camera.inverse() * point->position.cast<double>();
    return there.z() > 0 &&
           pictures_[shown_].touched.isFarFrom(before.camera.project(there.hnormalized()));
}

bool TracedPictures::toBegin() const {
    return toBegin_ && pictures_[0].portions == 0 && pictures_[1].portions == 0;
}

// Provides memory for two pictures traced while the camera moves. A tile with an object needs all
// its memory blocks (see Film::kBlockPixels); any other tile needs only one.
void TracedPictures::provide(RenderedPicture& out) {
    const auto blocksOf = [](const PixelRect& r, std::size_t pixels) {
        return static_cast<std::size_t>(r.area()) / pixels;
    };
    const PixelRect objects = scene_->tracer->objectBounds(wanted_);
    const PixelRect traced = scene_->tracer->bounds(wanted_);
    memory_->provide(
        2 * (blocksOf(objects, Film::kBlockPixels) + blocksOf(traced, sampling::kTilePixels)));
    resolver_.reserve(wanted_.camera.size, policy_.filter, out);
    providedFor_ = scene_;
}

/// Returns the scene for a picture that begins now. The picture will be shown after one `period_`,
/// and be replaced after two. Moving objects get the poses that they will have in the middle of
/// this time, after 1.5 periods.
std::shared_ptr<const PictureScene> TracedPictures::sceneOfNext() const {
    if (!scene_->moves()) return scene_;
    const double ahead = std::min(1.5 * period_, kFarthestAhead);
    return posed(*scene_, posesAt(*scene_->source,
                                  chosen_ + std::chrono::nanoseconds(std::llround(1e9 * ahead))));
}

void TracedPictures::begin() {
    Picture& picture = pictures_[1 - shown_];
    picture.scene = sceneOfNext();
    picture.wanted = wanted_;
    picture.coarseness = nextRests_ ? 0 : coarsenessOfNext(wanted_);
    picture.isTrial = !nextRests_ && coarseness_.lacksSpeed();
    if (!nextRests_ && !picture.isTrial) coarseness_.begin(picture.coarseness);
    picture.view = coarsened(wanted_, picture.coarseness);
    picture.chosen = chosen_;
    picture.rests = nextRests_;
    picture.shownSamples = picture.shownTurns = 0;
    picture.lookMs = 0;
    picture.wasShown = picture.counted = false;
    picture.history.reset();
    const Picture& shown = pictures_[shown_];
    if (policy_.history && shown.scene && shown.scene->objects == scene_->objects &&
        shown.hasLight()) {
        const bool sameLight = shown.scene->light == scene_->light;
        picture.history.emplace(picture.scene->tracer->historyOf(
            *shown.film, shown.view, sameLight ? kMostCarried : kMostCarriedElsewhere,
            shown.scene->poses));
        if (!sameLight) picture.history->forgetCatcher();
    }
    const Size size = picture.view.camera.size;
    if (!picture.film || !(picture.film->size() == size))
        picture.film = std::make_unique<Film>(size, memory_);
    picture.traced = picture.scene->tracer->bounds(picture.view);
    picture.film->begin();
    const PixelRect objects = picture.scene->tracer->objectBounds(picture.view);
    picture.slices.begin(picture.traced, size,
                         [&](const PixelRect& tile) { return densityOf(tile, picture, objects); });
    picture.touched.clear();
    toBegin_ = false;
}

TracedPictures::Portion TracedPictures::next(std::int64_t mostSamples) {
    Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || toShow()) return {};
    // Portions of a dropped picture can still read the shown picture's film as their history.
    if (pictures_[1 - working()].portions > 0) return {};
    Portion out{picture.slices.next(mostSamples), working()};
    if (!out.slice.pixels.empty()) ++picture.portions;
    return out;
}

void TracedPictures::trace(const Portion& portion) {
    Picture& picture = pictures_[portion.picture];
    picture.scene->tracer->trace(picture.view, portion.slice.pixels, portion.slice.samples,
                                 *picture.film, picture.history ? &*picture.history : nullptr);
}

// Returns the state by which Slices decides if the pixel gets more samples. In a picture for a
// camera at rest, only the pixel's own samples count as samples. Light of earlier pictures does not
// count, because it gives no sharp edges and textures.
PixelState TracedPictures::Picture::state(std::uint32_t pixel, const Exposure& exposure) const {
    const KnownLight known = rests ? KnownLight{} : film->known(pixel);
    return {film->error(pixel, exposure),
            std::max(std::min(known.firstCount, known.secondCount),
                     static_cast<float>(film->samples(pixel))),
            film->isUntouched(pixel)};
}

void TracedPictures::done(const Portion& portion, const Exposure& exposure, double ms) {
    Picture& picture = pictures_[portion.picture];
    --picture.portions;
    if (portion.slice.samples == 0) picture.lookMs += ms;
    tracedMs_ += ms;
    picture.slices.done(portion.slice,
                        [&](std::uint32_t pixel) { return picture.state(pixel, exposure); });
    if (picture.isTrial && picture.slices.turnComplete()) endTrial(picture);
}

/// True if no shown picture is of use in the present view, or if it has hardly any samples.
bool TracedPictures::isUrgent(const Picture& picture) const {
    const Picture& shown = pictures_[shown_];
    return !shown.scene || shown.shownTurns < Picture::kQuarterTurn ||
           shown.scene->objects != picture.scene->objects ||
           scene_->changeOf(shown.wanted, now_, policy_.limits) >= kHopeless;
}

bool TracedPictures::toShow() const {
    const Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || !picture.slices.turnComplete()) return false;
    if (pictures_[1 - working()].portions > 0) return false;
    if (picture.slices.finished()) return !picture.counted;
    const bool urgent = isUrgent(picture);
    if (!urgent && tracedMs_ < kTracedPerConverted * convertedMs_) return false;
    if (picture.slices.samples() > 0)
        return picture.slices.samples() >= leastSamples(picture, urgent);
    return maybeSparse(picture) && picture.slices.turns() >= leastTurns(picture, urgent);
}

/// Number of samples per pixel from which the picture may be shown.
int TracedPictures::leastSamples(const Picture& picture, bool urgent) const {
    if (picture.wasShown) return std::max(kSamplesRatio * picture.shownSamples, 1);
    if (urgent || maybeSparse(picture)) return 1;
    if (!nextRests_) return policy_.samplesToReplace;
    // Compared with a coarse picture, fewer samples give the same noise of an area.
    const Picture& shown = pictures_[shown_];
    return std::max(shown.coarseness > 0 ? 1 : policy_.samplesToReplace,
                    shown.shownSamples >> shown.coarseness);
}

/// Number of turns from which a sparsely sampled picture may be shown.
int TracedPictures::leastTurns(const Picture& picture, bool urgent) const {
    if (picture.wasShown) return std::max(picture.shownTurns + 1, Picture::kQuarterTurn);
    const bool isLate = urgent && secondsSince(picture.chosen) > kLongWait && !rest_.rests();
    return isLate ? Picture::kQuarterTurn - 1 : Picture::kQuarterTurn;
}

// True if the picture may be shown before every pixel has a sample. While the camera moves,
// filtered light of few samples is better than no picture or a picture of another view.
bool TracedPictures::maybeSparse(const Picture& picture) const {
    if (picture.rests || !policy_.filter) return false;
    const Picture& shown = pictures_[shown_];
    return &picture == &shown || !shown.scene || (policy_.soon && policy_.history);
}

void TracedPictures::beginShow(const Exposure& exposure, RenderedPicture& out) {
    const Picture& picture = pictures_[working()];
    resolver_.begin(*picture.film, picture.view, picture.traced, exposure, policy_.filter, out,
                    !picture.rests);
}

void TracedPictures::endShow(RenderedPicture& out, double ms) {
    Picture& picture = pictures_[working()];
    convertedMs_ = ms;
    tracedMs_ = 0;
    out.scene = picture.scene->source;
    out.poses = picture.scene->poses;
    out.mirrors = picture.scene->tracer->mirrorLight();
    picture.touched.set(out);
    picture.shownSamples = picture.slices.samples();
    picture.shownTurns = picture.slices.turns();
    if (!picture.wasShown) {
        const double seconds = secondsSince(picture.chosen);
        period_ += kPeriodShare * (seconds - period_);
        if (!picture.rests)
            coarseness_.learn(picture.scene->tracedPixels(picture.wanted), picture.coarseness,
                              seconds);
    }
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
