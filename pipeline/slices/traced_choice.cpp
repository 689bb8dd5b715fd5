// The part of TracedPictures that chooses whether a new picture begins, and its resolution.

#include "pipeline/slices/traced_pictures.h"

#include <algorithm>

namespace mfar {
namespace {

// With TracedPolicy::soon, a new picture begins when the change of the view since the shown picture
// reaches this share of ViewLimits. Otherwise, it begins at the full ViewLimits.
constexpr double kSoon = 0.75;
// While the camera rests, the shown picture should not need to be warped. So a new picture begins
// if objects in the shown picture are more than this distance away from their present places [px].
constexpr double kElsewherePixels = 0.2;
// Tolerated motion of an object's shadow since the shown picture [px], see motionSince(). The
// shadow is assumed to move as far as the object.
constexpr double kShadowPixels = 1;

}  // namespace

// Returns the change from the picture's view to the present view. Returns nothing if the objects
// have changed. For the shown picture, also returns nothing if the lighting has changed. For the
// next picture, a change of the lighting does not count: the picture might otherwise be begun again
// and again and never be finished.
std::optional<double> TracedPictures::changeSince(const Picture& picture) const {
    const bool isShown = &picture == &pictures_[shown_];
    if (!picture.scene || picture.scene->objects != scene_->objects ||
        (isShown && picture.scene->light != scene_->light))
        return {};
    return picture.scene->changeOf(picture.wanted, now_, policy_.limits);
}

/// Returns the largest motion of an object since a picture, divided by its limit. The warp can move
/// objects in the picture, so the limit for an object is ViewLimits. The warp cannot move shadows,
/// so the limit for the object's shadow is kShadowPixels.
double TracedPictures::motionSince(const Picture& picture) const {
    double change = 0;
    for (const auto& [object, own] : scene_->moving) {
        const RigidTransform& T_world_then = picture.scene->poses[object];
        const ObjectBall ball{T_world_then * own.centre, own.radius};
        // `view` shows the object at its pose in the picture exactly as the camera now sees the
        // object at its present pose.
        const RenderView view{now_.camera,
                              T_world_then * posesNow_[object].inverse() * now_.T_world_camera};
        change = std::max({change, viewChange(picture.wanted, view, {&ball, 1}, policy_.limits),
                           pixelChange(now_, view, {&ball, 1}) / kShadowPixels});
    }
    return change;
}

TracedStep TracedPictures::chosenStep() const {
    std::optional<double> sinceShown = changeSince(pictures_[shown_]);
    const bool serves = sinceShown && *sinceShown < 1;
    if (sinceShown && scene_->moves())
        sinceShown = std::max(*sinceShown, motionSince(pictures_[shown_]));
    const bool rests = rest_.rests();
    const bool hasBegun = hasNext_ && !toBegin_;
    const std::optional<double> sinceNext =
        hasBegun ? changeSince(pictures_[1 - shown_]) : std::nullopt;
    if (sinceNext && nextRests_ && rests) return TracedStep::Continue;
    const bool isElsewhere =
        sinceShown && pixelChange(pictures_[shown_].wanted, now_, scene_->balls) > kElsewherePixels;
    const Picture& shown = pictures_[shown_];
    if (!hasBegun && rests && (isElsewhere || (shown.wasShown && !shown.rests)))
        return TracedStep::Start;
    const TracedStep step = nextStep(sinceShown, sinceNext, policy_.soon ? kSoon : 1);
    if (step == TracedStep::Refine && isTooCoarse(shown)) return TracedStep::Start;
    // A new picture reuses the light of the shown picture, which has none before its first samples.
    // So the shown picture gets these samples first, if it still is near enough to the present
    // view.
    const bool lacksSamples = scene_->moves() ? !shown.hasLight() : shown.slices.samples() == 0;
    if (step == TracedStep::Start && !hasBegun && serves && lacksSamples) return TracedStep::Refine;
    // The next picture is kept while objects move: even if they are now near their positions in the
    // shown picture, they will soon be elsewhere. It is also kept if it has a higher resolution.
    const bool isFiner = hasBegun && pictures_[1 - shown_].coarseness < shown.coarseness;
    if (step == TracedStep::Drop && (isFiner || scene_->moves())) return TracedStep::Continue;
    return step;
}

/// True if no picture of these objects was shown. Their first picture may be coarse, even if the
/// camera rests. A new shadow catcher does not count: the shown picture is better than a coarse
/// one.
bool TracedPictures::isNew() const {
    const Picture& shown = pictures_[shown_];
    return policy_.shownWithin > 0 &&
           !(shown.scene && shown.scene->source->objects == scene_->source->objects);
}

double TracedPictures::secondsSince(Timestamp begin) const {
    return secondsBetween(begin, time_);
}

/// True if the shown picture should be replaced by one of higher resolution of about the same view.
bool TracedPictures::isTooCoarse(const Picture& shown) const {
    return shown.coarseness > 0 && shown.wasShown && shown.hasLight() &&
           coarsenessOfNext(now_) < shown.coarseness;
}

/// Coarseness of a picture for a moving camera, finer than a shown one that got many samples.
int TracedPictures::coarsenessOfNext(const RenderView& view) const {
    const Picture& shown = pictures_[shown_];
    const bool serves = shown.scene && shown.scene->objects == scene_->objects;
    const std::optional<double> waited =
        serves ? std::nullopt : std::optional(secondsSince(chosen_));
    const int chosen = coarseness_.chosen(scene_->tracedPixels(view), waited);
    const bool isDone =
        shown.slices.finished() || shown.slices.samples() >= policy_.samplesToReplace;
    const bool hadTime = serves && shown.wasShown && shown.coarseness > 0 && isDone;
    return hadTime ? std::min(chosen, shown.coarseness - 1) : chosen;
}

/// The very first picture has the lowest resolution. As soon as its pixels have a ray through their
/// centres, the speed is known. If a finer picture can be shown soon, it begins instead.
void TracedPictures::endTrial(Picture& picture) {
    picture.isTrial = false;
    coarseness_.learnFromLook(static_cast<double>(picture.slices.pixels()), picture.lookMs,
                              secondsSince(picture.chosen));
    const bool isNext = hasNext_ && &picture == &pictures_[working()];
    if (isNext && coarsenessOfNext(wanted_) < picture.coarseness) toBegin_ = true;
}

void TracedPictures::look(const RenderView& now, const RenderView& predicted, Timestamp time) {
    now_ = now;
    time_ = time;
    if (!scene_) return;
    if (scene_->moves()) posesNow_ = posesAt(*scene_->source, time);
    if (scene_->moves())
        rest_.reset();
    else
        rest_.look(now_, scene_->balls);
    switch (chosenStep()) {
    case TracedStep::Start:
        hasNext_ = toBegin_ = true;
        nextRests_ = rest_.rests() && !isNew();
        wanted_ = nextRests_ ? now : predicted;
        chosen_ = time;
        break;
    case TracedStep::Refine:
    case TracedStep::Drop: hasNext_ = toBegin_ = false; break;
    case TracedStep::Continue: break;
    }
}

}  // namespace mfar
