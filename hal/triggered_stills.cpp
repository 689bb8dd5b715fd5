#include "hal/triggered_stills.h"

#include <algorithm>
#include <utility>

namespace mfar {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLookAround{50};

Frame retimed(Frame frame, Timestamp time, std::chrono::nanoseconds exposure) {
    const auto held = std::make_shared<std::optional<Frame>>(std::move(frame));
    Frame renamed((*held)->view(), time, [held] { held->reset(); });
    renamed.exposure = exposure;
    return renamed;
}

}  // namespace

TriggeredStillCamera::TriggeredStillCamera(std::unique_ptr<Camera> camera,
                                           std::unique_ptr<Trigger> trigger,
                                           const TriggeredStillOptions& options)
    : camera_(std::move(camera)), trigger_(std::move(trigger)), exposure_(options.exposure),
      matcher_(options.matching) {}

CameraInfo TriggeredStillCamera::info() const {
    CameraInfo info = camera_->info();
    info.rateHz = 0;
    return info;
}

void TriggeredStillCamera::start() {
    stopped_ = false;
    trigger_->rest();
    camera_->start();
}

void TriggeredStillCamera::stop() {
    {
        // fire() also locks mutex_, so that no pulse is fired once stopped_ is set.
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    trigger_->endPulse();
    camera_->stop();
}

std::optional<Frame> TriggeredStillCamera::next(milliseconds timeout) {
    const Timestamp deadline = Timestamp::now() + timeout;
    while (!stopped_) {
        trigger_->rest();
        repeatLost();
        const auto left = std::chrono::ceil<milliseconds>(deadline - Timestamp::now());
        std::optional<Frame> frame = camera_->next(std::clamp(left, milliseconds{0}, kLookAround));
        if (frame) {
            frame = admit(std::move(*frame));
            if (frame) return frame;
        } else if (left <= milliseconds{0} || camera_->ended()) {
            break;
        }
    }
    return std::nullopt;
}

void TriggeredStillCamera::repeatLost() {
    std::lock_guard lock(mutex_);
    if (stopped_) return;
    if (!matcher_.poll(Timestamp::now()).repeat) return;
    try {
        matcher_.pulseFired(trigger_->fire(), StillMatcher::Pulse::Repetition);
    } catch (const TriggerBusy&) {
        // The next call of repeatLost() tries to repeat the lost pulse again.
    }
}

std::optional<Frame> TriggeredStillCamera::admit(Frame frame) {
    std::lock_guard lock(mutex_);
    const auto match = matcher_.stillArrived(frame.time() - frame.exposure / 2);
    if (!match) return std::nullopt;
    const std::chrono::nanoseconds exposure = exposure_.count() > 0 ? exposure_ : frame.exposure;
    const Timestamp time = match->exposed + exposure / 2;
    if (newest_ && time <= *newest_) {
        ++overtaken_;
        return std::nullopt;
    }
    newest_ = time;
    return retimed(std::move(frame), time, exposure);
}

Timestamp TriggeredStillCamera::fire() {
    std::lock_guard lock(mutex_);
    if (stopped_) throw TriggerBusy(name() + ": the camera is stopped");
    const Timestamp edge = trigger_->fire();
    matcher_.pulseFired(edge);
    return edge;
}

StillCounters TriggeredStillCamera::counters() const {
    StillCounters out;
    {
        std::lock_guard lock(mutex_);
        out = matcher_.counters();
        out.overtaken = overtaken_;
    }
    out.missedEdges = missedEdges();
    return out;
}

}  // namespace mfar
