#include "daemon/still_policy.h"

#include <algorithm>

namespace mfar {
namespace {

/// Smallest share of changed tiles that counts as motion. Noise, flicker or a blinking light change
/// a smaller share.
constexpr double kMovedShare = 0.05;

/// Longest pause after a still and its repetition were lost. The camera may be unplugged, and the
/// next still must come soon after the camera is plugged in again.
constexpr double kLongestPauseS = 10;

/// Pause after a trigger that could not fire.
constexpr double kRetryS = 1;

std::chrono::nanoseconds toNanoseconds(double s) {
    return std::chrono::nanoseconds{Timestamp::fromSeconds(s).ns};
}

}  // namespace

bool StillPolicy::decide(Timestamp now, Timestamp before, const FrameStats& stats, bool mayDemand) {
    if (still_ && !usedSince_) usedSince_ = now;
    const bool moves = stats.changed > kMovedShare;
    if (moves && !moved_ && firedAt_ && now > *firedAt_) moved_ = now;
    if (moves && usedSince_ && now > *usedSince_) movedInUse_ = true;
    if (retryAt_ && now < *retryAt_) return false;
    const bool isDue = config_.mode == TriggerMode::Rate && (!due_ || now >= *due_);
    const bool wants = asked_ || isDue || (mayDemand && demanded(now, before, stats));
    const bool fires = pending() ? repeatsAt(now) : wants;
    if (fires) fire(now);
    return fires;
}

void StillPolicy::configure(const TriggerConfig& config) {
    if (config.mode == TriggerMode::Off && config_.mode != TriggerMode::Off) arrived_ = true;
    // With another rate, the next trigger does not wait for the end of the old period.
    if (config.mode != config_.mode || config.rateHz != config_.rateHz) due_.reset();
    config_ = config;
    usedSince_.reset();
    notBefore_.reset();
    retryAt_.reset();
}

void StillPolicy::busy() {
    --fired_;
    arrived_ = true;
    asked_ = true;
}

void StillPolicy::failed() {
    busy();
    retryAt_ = *firedAt_ + toNanoseconds(kRetryS);
}

void StillPolicy::stillArrived(Timestamp exposed) {
    still_ = exposed;
    usedSince_.reset();
    movedInUse_ = false;
    if (firedAt_ && exposed < *firedAt_) return;
    arrived_ = true;
    repeated_ = false;
    notBefore_.reset();
}

bool StillPolicy::demanded(Timestamp now, Timestamp before, const FrameStats& stats) const {
    if (config_.mode != TriggerMode::Demand || (notBefore_ && now < *notBefore_)) return false;
    if (!still_) return true;
    if (firedAt_ && now - *firedAt_ < toNanoseconds(config_.minIntervalS)) return false;
    if (movedInUse_ && now - *still_ > toNanoseconds(config_.maxAgeS)) return true;
    // A still is requested only if the scene has moved since the last trigger. Without motion, a
    // new still would look like the current one and explain no more of the picture.
    return moved_ && before >= *moved_ && before >= *usedSince_ &&
           stats.explained < config_.explainedBelow;
}

// Returns true if the pending still is lost and must be requested once more.
bool StillPolicy::repeatsAt(Timestamp now) {
    const Timestamp since = std::max(*firedAt_, comingAt_.value_or(*firedAt_));
    if (now - since < toNanoseconds(config_.timeoutS)) return false;
    ++timedOut_;
    arrived_ = true;
    repeated_ = !repeated_;
    repetitions_ += repeated_ ? 1 : 0;
    if (!repeated_ && config_.mode == TriggerMode::Demand)
        notBefore_ = now + toNanoseconds(std::min(config_.maxAgeS, kLongestPauseS));
    return repeated_;
}

void StillPolicy::fire(Timestamp now) {
    // If this trigger was due at `due_`, the next one is due one period after `due_`, not one
    // period after `now`. `now` is the time of a frame, a little later than `due_`. Counting from
    // `now` would make the rate too low.
    const std::chrono::nanoseconds period = toNanoseconds(1 / config_.rateHz);
    due_ = due_ && now >= *due_ && now - *due_ < period ? *due_ + period : now + period;
    firedAt_ = now;
    retryAt_.reset();
    arrived_ = false;
    asked_ = false;
    moved_.reset();
    ++fired_;
}

}  // namespace mfar
