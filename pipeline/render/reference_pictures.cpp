#include "pipeline/render/reference_pictures.h"

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

std::optional<double> ReferencePictures::changeSince(const Picture& picture) const {
    if (!picture.scene || picture.scene->objects != scene_->objects ||
        picture.scene->light != scene_->light)
        return {};
    return viewChange(picture.view, now_, scene_->balls, policy_.limits);
}

void ReferencePictures::look(const RenderView& now, const RenderView& predicted, Timestamp time) {
    now_ = now;
    if (!scene_) return;
    const std::optional<double> sinceNext =
        hasNext_ && !toBegin_ ? changeSince(pictures_[1 - shown_]) : std::nullopt;
    switch (nextStep(changeSince(pictures_[shown_]), sinceNext)) {
    case ReferenceStep::Start:
        hasNext_ = toBegin_ = true;
        wanted_ = predicted;
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
        picture.film->clear(picture.traced);
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
    return policy_.samplesToReplace;
}

bool ReferencePictures::toShow() const {
    const Picture& picture = pictures_[working()];
    if (toBegin_ || !picture.scene || !picture.slices.turnComplete()) return false;
    // Of the one whose place it takes.
    if (pictures_[1 - working()].portions > 0) return false;
    if (picture.slices.finished()) return !picture.counted;
    return picture.slices.samples() >= leastSamples(picture);
}

void ReferencePictures::resolve(const Exposure& exposure, RenderedPicture& out) {
    Picture& picture = pictures_[working()];
    picture.film->resolve(picture.view, exposure, out, policy_.filter ? &filter_ : nullptr);
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
