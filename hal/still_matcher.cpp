#include "hal/still_matcher.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace mfar {
namespace {

using std::chrono::nanoseconds;

/// Number of remembered pulses; far more than can wait for their stills at a time.
constexpr std::size_t kRemembered = 64;
/// Number of consecutive stills that must miss the window by about the same time before the
/// camera's clock counts as stepped.
constexpr std::size_t kStepEvidence = 5;
constexpr nanoseconds kLongest = std::chrono::hours(1);

std::int64_t median(std::vector<std::int64_t> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

void require(bool sound, const char* what) {
    if (!sound) throw std::invalid_argument(what);
}

bool isLength(nanoseconds time) {
    return time > nanoseconds{0} && time <= kLongest;
}

}  // namespace

StillMatcher::StillMatcher(const StillMatcherOptions& options) : options_(options) {
    require(isLength(options.window) && isLength(options.wideWindow),
            "StillMatcherOptions: window and wideWindow must be above 0 and at most 1 h");
    require(isLength(options.timeout),
            "StillMatcherOptions: timeout must be above 0 and at most 1 h");
    require(options.guess >= -kLongest && options.guess <= kLongest,
            "StillMatcherOptions: guess must be from -1 h to 1 h");
    require(options.learnFrom > 0, "StillMatcherOptions: learnFrom must be at least 1");
}

void StillMatcher::pulseFired(Timestamp edge, Pulse kind) {
    if (kind == Pulse::Repetition) {
        const auto owed = std::ranges::find(pulses_, true, &Fired::owed);
        if (owed != pulses_.end()) owed->owed = false;
        ++counters_.repeated;
    }
    ++counters_.fired;
    const auto after = std::ranges::upper_bound(pulses_, edge, {}, &Fired::edge);
    pulses_.insert(after, Fired{edge, kind});
    if (pulses_.size() <= kRemembered) return;
    if (pulses_.front().state == State::Waiting) ++counters_.lost;
    pulses_.pop_front();
}

std::int64_t StillMatcher::centre() const {
    return learned_.value_or(options_.guess.count());
}

nanoseconds StillMatcher::constant() const {
    if (learned_ || samples_.empty()) return nanoseconds{centre()};
    return nanoseconds{median(samples_)};
}

/// Returns the pulse whose expected exposure is nearest in time. Returns nothing if every pulse is
/// more than three hours away.
std::optional<StillMatcher::Nearest> StillMatcher::nearest(Timestamp exposed) const {
    std::optional<Nearest> best;
    for (std::size_t i = 0; i < pulses_.size(); ++i) {
        std::int64_t since = 0;
        if (__builtin_sub_overflow(exposed.ns, pulses_[i].edge.ns, &since)) continue;
        if (since < -3 * kLongest.count() || since > 3 * kLongest.count()) continue;
        if (!best || std::abs(since - centre()) < std::abs(best->sinceEdge - centre()))
            best = Nearest{i, since};
    }
    return best;
}

std::int64_t StillMatcher::reach(std::size_t index, std::int64_t window) const {
    const std::int64_t edge = pulses_[index].edge.ns;
    if (index > 0) window = std::min(window, (edge - pulses_[index - 1].edge.ns) / 2);
    if (index + 1 < pulses_.size())
        window = std::min(window, (pulses_[index + 1].edge.ns - edge) / 2);
    return window;
}

std::optional<StillMatcher::Match> StillMatcher::stillArrived(Timestamp exposed) {
    const std::optional<Nearest> still = nearest(exposed);
    const nanoseconds window = learned_ ? options_.window : options_.wideWindow;
    const bool fits =
        still && std::abs(still->sinceEdge - centre()) <= reach(still->index, window.count());
    if (!fits || pulses_[still->index].state == State::Matched) {
        ++counters_.unmatched;
        if (still && !fits) misfit(*still);
        return std::nullopt;
    }
    Fired& pulse = pulses_[still->index];
    const bool late = pulse.state == State::Lost;
    pulse.state = State::Matched;
    pulse.owed = false;
    ++counters_.matched;
    if (late) ++counters_.late;
    misfits_.clear();
    if (!learned_) learn(still->sinceEdge);
    return Match{pulse.edge, pulse.edge + constant(), late};
}

void StillMatcher::learn(std::int64_t sinceEdge) {
    samples_.push_back(sinceEdge);
    if (samples_.size() < static_cast<std::size_t>(options_.learnFrom)) return;
    learned_ = median(samples_);
    samples_.clear();
}

// Remembers a still that missed the window, as evidence that the camera's clock has stepped, or
// that the first estimate of the delay was wrong. The still must be within wideWindow of the
// nearest pulse's expected time. But if that pulse still waits for its still (and does not count as
// lost), or nothing is learned yet, it must be within kLongest: the reported time may be wrong by
// more than wideWindow, e.g. by an exposure time that the camera chose itself.
void StillMatcher::misfit(const Nearest& still) {
    const bool isWaiting = pulses_[still.index].state == State::Waiting;
    const nanoseconds window = isWaiting || !learned_ ? kLongest : options_.wideWindow;
    const std::int64_t wide = reach(still.index, window.count());
    if (std::abs(still.sinceEdge - centre()) > wide) return;
    misfits_.push_back(still.sinceEdge);
    if (misfits_.size() < kStepEvidence) return;
    const auto [least, most] = std::ranges::minmax(misfits_);
    if (most - least <= 2 * options_.window.count()) {
        if (learned_) ++counters_.relearned;
        learned_ = median(misfits_);
        samples_.clear();
        misfits_.clear();
    } else {
        misfits_.erase(misfits_.begin());
    }
}

void StillMatcher::giveUp(Fired& pulse, int& lost) {
    pulse.state = State::Lost;
    pulse.owed = options_.repeat && pulse.kind == Pulse::Asked;
    ++counters_.lost;
    ++lost;
}

StillMatcher::Due StillMatcher::poll(Timestamp now) {
    Due due;
    const nanoseconds patience = options_.timeout + std::max(constant(), nanoseconds{0});
    for (Fired& pulse : pulses_) {
        if (pulse.state == State::Waiting && now - pulse.edge > patience) giveUp(pulse, due.lost);
        due.repeat = due.repeat || pulse.owed;
    }
    return due;
}

}  // namespace mfar
