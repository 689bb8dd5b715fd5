#include "pipeline/slices/reference_pictures.h"

#include <algorithm>
#include <limits>

namespace mfar {
namespace {

// A next picture is given up when the camera has come back half of the way.
constexpr double kBack = 0.5;
// So many limits away from its view the picture shown is worse than a noisy one.
constexpr double kHopeless = 3;
// A finer picture is worth a conversion when its error has halved.
constexpr int kSamplesRatio = 4;
// A camera that moves by less for so many looks rests; then what is farther off is warped for
// nothing.
constexpr double kRestPixels = 0.1, kElsewherePixels = 0.2;
constexpr int kRestLooks = 10;

}  // namespace

ReferenceStep nextStep(std::optional<double> sinceShown, std::optional<double> sinceNext) {
    if (!sinceNext)
        return sinceShown && *sinceShown < 1 ? ReferenceStep::Refine : ReferenceStep::Start;
    // The very first picture is finished wherever the camera goes: it is better than none.
    if (!sinceShown) return ReferenceStep::Continue;
    if (*sinceShown < kBack) return ReferenceStep::Drop;
    return *sinceNext >= 1 && *sinceNext > *sinceShown ? ReferenceStep::Start
                                                       : ReferenceStep::Continue;
}

ReferencePictures::ReferencePictures(const SliceOptions& slices, const ReferencePolicy& policy)
    : slices_(slices), policy_(policy), pictures_{Picture(slices), Picture(slices)} {}

// The light of one in the making counts once it is shown: where it changes all the time, none would
// be finished.
std::optional<double> ReferencePictures::changeSince(const Picture& picture) const {
    const bool isShown = &picture == &pictures_[shown_];
    if (!picture.scene || picture.scene->objects != scene_->objects ||
        (isShown && picture.scene->light != scene_->light))
        return {};
    return viewChange(picture.view, now_, scene_->balls, policy_.limits);
}

void ReferencePictures::watchRest() {
    if (pixelChange(restsAt_, now_, scene_->balls) < kRestPixels) {
        restLooks_ = std::min(restLooks_ + 1, kRestLooks);
    } else {
        restsAt_ = now_;
        restLooks_ = 0;
    }
}

ReferenceStep ReferencePictures::chosenStep() const {
    const std::optional<double> sinceShown = changeSince(pictures_[shown_]);
    const bool rests = restLooks_ == kRestLooks;
    const bool hasBegun = hasNext_ && !toBegin_;
    if (hasBegun && nextRests_ && rests) return ReferenceStep::Continue;
    const bool isElsewhere =
        sinceShown && pixelChange(pictures_[shown_].view, now_, scene_->balls) > kElsewherePixels;
    if (!hasBegun && rests && isElsewhere) return ReferenceStep::Start;
    return nextStep(sinceShown,
                    hasNext_ && !toBegin_ ? changeSince(pictures_[1 - shown_]) : std::nullopt);
}

void ReferencePictures::look(const RenderView& now, const RenderView& predicted, Timestamp time) {
    now_ = now;
    if (!scene_) return;
    watchRest();
    const bool rests = restLooks_ == kRestLooks;
    switch (chosenStep()) {
    case ReferenceStep::Start:
        hasNext_ = toBegin_ = true;
        nextRests_ = rests;
        wanted_ = rests ? now : predicted;
        chosen_ = time;
        break;
    case ReferenceStep::Refine:
    case ReferenceStep::Drop: hasNext_ = toBegin_ = false; break;
    case ReferenceStep::Continue: break;
    }
}

bool ReferencePictures::toBegin() const {
    return toBegin_ && pictures_[1 - shown_].portions == 0;
}

void ReferencePictures::begin() {
    Picture& picture = pictures_[1 - shown_];
    picture.scene = scene_;
    picture.view = wanted_;
    picture.chosen = chosen_;
    picture.shownSamples = 0;
    picture.wasShown = picture.counted = false;
    if (picture.film && picture.film->size() == wanted_.camera.size)
        picture.film->clear();
    else
        picture.film = std::make_unique<Film>(wanted_.camera.size);
    picture.traced = scene_->tracer->bounds(wanted_);
    picture.slices.begin(picture.traced, wanted_.camera.size);
    toBegin_ = false;
}

ReferencePictures::Portion ReferencePictures::next(std::int64_t mostSamples) {
    Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || toShow()) return {};
    Portion out{picture.slices.next(mostSamples), working()};
    if (!out.slice.pixels.empty()) ++picture.portions;
    return out;
}

void ReferencePictures::trace(const Portion& portion) {
    Picture& picture = pictures_[portion.picture];
    picture.scene->tracer->trace(picture.view, portion.slice.pixels, portion.slice.samples,
                                 *picture.film);
}

void ReferencePictures::done(const Portion& portion, const Exposure& exposure) {
    Picture& picture = pictures_[portion.picture];
    --picture.portions;
    picture.slices.done(portion.slice,
                        [&](std::uint32_t pixel) { return picture.film->error(pixel, exposure); });
}

int ReferencePictures::leastSamples(const Picture& picture) const {
    if (picture.wasShown) return kSamplesRatio * picture.shownSamples;
    const Picture& shown = pictures_[shown_];
    if (!shown.scene || shown.scene->objects != picture.scene->objects ||
        viewChange(shown.view, now_, scene_->balls, policy_.limits) >= kHopeless)
        return 1;
    // At rest nothing is to become worse.
    return nextRests_ ? std::max(policy_.samplesToReplace, shown.shownSamples)
                      : policy_.samplesToReplace;
}

bool ReferencePictures::toShow() const {
    const Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || !picture.slices.turnComplete()) return false;
    // Of the one whose place it takes.
    if (pictures_[1 - working()].portions > 0) return false;
    if (picture.slices.finished()) return !picture.counted;
    return picture.slices.samples() >= leastSamples(picture);
}

void ReferencePictures::beginShow(const Exposure& exposure, RenderedPicture& out) {
    const Picture& picture = pictures_[working()];
    resolver_.begin(*picture.film, picture.view, picture.traced, exposure, policy_.filter, out);
}

void ReferencePictures::endShow(RenderedPicture& out) {
    Picture& picture = pictures_[working()];
    out.scene = picture.scene->source;
    picture.shownSamples = picture.slices.samples();
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

bool ReferencePictures::settled() const {
    const Picture& picture = pictures_[working()];
    return !toBegin_ && (!picture.scene || (picture.slices.finished() && picture.counted));
}

double ReferencePictures::progress() const {
    const Picture& picture = pictures_[working()];
    return picture.scene && !toBegin_ ? picture.slices.progress() : 1;
}

std::size_t ReferencePictures::pixels() const {
    return pictures_[working()].slices.pixels();
}

std::optional<Timestamp> ReferencePictures::shownSince() const {
    const Picture& shown = pictures_[shown_];
    return shown.scene && shown.wasShown ? std::optional(shown.chosen) : std::nullopt;
}

}  // namespace mfar
