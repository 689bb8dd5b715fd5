#include "daemon/governor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

// The governor changes to a level only if the level's expected time is at most this share of the
// deadline: kRoom for a change to a better level, kDownRoom for a change to a faster one. The
// fastest level needs no room.
constexpr double kRoom = 0.85;
constexpr double kDownRoom = 0.95;
// A faster level is chosen when more than kMostLate of the last kLateWindow counted frames are
// late. A frame with a new still is counted only if the frame before it had a new still, too. If
// the last frame with a new still was late, only one in kStillEvery frames gets a new still. So of
// 40 frames, at most two are late: one with a new still and one without.
constexpr std::size_t kMostLate = 1;
constexpr std::uint64_t kLateWindow = 40;
// Smallest number of counted frames between a change of level and a change to a better level.
constexpr std::uint64_t kSettle = 8;
// A level that missed the deadline is not used for the next kFirstWait counted frames (see
// kMostLate). This number doubles with each further failure of the level, up to kLongestWait.
constexpr std::uint64_t kFirstWait = 20, kLongestWait = 960;
// If a level misses the deadline only after at least kHeld counted frames, the scene has probably
// changed. So this counts as the level's first failure: the level is not used for the next
// kFirstWait counted frames. Also, after kHeld counted frames at a level of which none of the last
// kLateWindow was late, the next better level may be tried.
constexpr std::uint64_t kHeld = 100;
// The picture counts as at rest after this number of frames in which nothing was redrawn.
constexpr int kAtRest = 3;
constexpr std::uint64_t kStillEvery = 40;

}  // namespace

Governor::Governor(std::vector<QualityLevel> levels, double deadlineMs)
    : levels_(std::move(levels)), deadline_(deadlineMs), trials_(levels_.size()) {
    assert(!levels_.empty() && deadlineMs > 0);
    lateAt_.reserve(kMostLate + 1);
    framesSinceStill_ = kStillEvery;
    level_ = bestWithin(kRoom * deadline_);
    next_.level = level_;
}

void Governor::add(const Frame& frame) {
    if (!(frame.ms >= 0 && std::isfinite(frame.ms))) return;
    // A frame with a new still may be late. But if each frame has one, these frames must count.
    const bool mayBeLate = frame.newStill && framesSinceStill_ > 0;
    framesSinceStill_ = frame.newStill ? 0 : framesSinceStill_ + 1;
    if (frame.newStill) stillMs_ = frame.ms;
    if (frame.redrawn > 0 && !next_.redraw) {
        restFrames_ = 0;
        isPolished_ = false;
        const bool isComplete = frame.usedStill || level().quality.mode == SuperResMode::Off;
        if (isComplete && !mayBeLate) count(frame.ms);
    } else {
        ++restFrames_;
    }
    rest();
}

void Governor::rest() {
    const bool wanted =
        restFrames_ >= kAtRest && !isPolished_ && !next_.redraw && level_ + 1 < levels_.size();
    if (wanted) isPolished_ = true;
    next_ = wanted ? Choice{levels_.size() - 1, true} : Choice{level_, false};
}

void Governor::count(double ms) {
    ratios_[frame_ % kWindow] = ms / levels_[level_].ms;
    ratioCount_ = std::min(ratioCount_ + 1, kWindow);
    ++frame_;
    std::erase_if(lateAt_, [&](std::uint64_t at) { return at + kLateWindow <= frame_; });
    if (ms > deadline_) lateAt_.push_back(frame_);
    if (lateAt_.size() > kMostLate)
        goDown();
    else if (frame_ - changedAt_ >= kSettle)
        goUp();
}

void Governor::goDown() {
    if (level_ == 0) return lateAt_.clear();
    Trial& failed = trials_[level_];
    if (frame_ - changedAt_ >= kHeld) failed.wait = 0;
    failed.wait = std::clamp(2 * failed.wait, kFirstWait, kLongestWait);
    failed.notBefore = frame_ + failed.wait;
    goTo(std::min(bestWithin(kDownRoom * deadline_), level_ - 1));
}

void Governor::goUp() {
    const std::size_t best = bestWithin(kRoom * deadline_);
    if (best > level_)
        goTo(best);
    else if (mayTry(level_ + 1))
        goTo(level_ + 1);
}

// A part of the measured time may be the same at all levels, e.g. the wait for the display. Then
// the factor that was measured at a fast level makes a better level look too slow. Without a trial
// of the better level, no measurement would ever correct this.
bool Governor::mayTry(std::size_t level) const {
    if (level >= levels_.size() || frame_ < trials_[level].notBefore) return false;
    if (frame_ - changedAt_ < kHeld || !lateAt_.empty()) return false;
    return expected(level_) + levels_[level].ms - levels_[level_].ms <= kRoom * deadline_;
}

void Governor::goTo(std::size_t level) {
    level_ = level;
    changedAt_ = frame_;
    lateAt_.clear();
    ++changes_;
}

// Returns the best level that may be used now and whose expected time is at most `ms`. Returns the
// fastest level if there is none.
std::size_t Governor::bestWithin(double ms) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < levels_.size(); ++i)
        if (expected(i) <= ms && (i <= level_ || trials_[i].notBefore <= frame_)) best = i;
    return best;
}

double Governor::expected(std::size_t level) const {
    return ratio() * levels_[level].ms;
}

double Governor::ratio() const {
    if (ratioCount_ == 0) return 1;
    std::array<double, kWindow> sorted = ratios_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(ratioCount_);
    const std::size_t rank = ratioCount_ < kWindow / 2 ? 0 : 1;
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(sorted.begin(), at, end, std::greater<>());
    return *at;
}

bool Governor::mayTakeStill() const {
    if (levels_[level_].quality.mode == SuperResMode::Off) return false;
    return framesSinceStill_ >= kStillEvery || !(stillMs_.value_or(0) > deadline_);
}

}  // namespace mfar
