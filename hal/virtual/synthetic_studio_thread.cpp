#include "hal/gl_context.h"
#include "hal/virtual/synthetic_hash.h"
#include "hal/virtual/synthetic_studio.h"
#include "hal/virtual/synthetic_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kVideoAhead = 2;
constexpr int kVideoNoise = 1, kStillNoise = 2;

}  // namespace

void SyntheticStudio::run(std::promise<void>& ready) {
    std::optional<Views> views;
    try {
        views.emplace(options_, world_, rig_);
    } catch (...) {
        ready.set_exception(std::current_exception());
        return;
    }
    ready.set_value();
    try {
        serve(*views);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        failure_ = std::current_exception();
        requests_.clear();
        changed_.notify_all();
    }
}

void SyntheticStudio::serve(Views& views) {
    for (;;) {
        std::unique_lock lock(mutex_);
        switch (chooseWork(lock)) {
        case Work::Quit: return;
        case Work::Request: {
            auto task = std::move(requests_.front());
            requests_.pop_front();
            lock.unlock();
            task(views);
            break;
        }
        case Work::Video:
            lock.unlock();
            makeVideo(views);
            break;
        case Work::Still:
            lock.unlock();
            stepStill(views);
            break;
        }
    }
}

SyntheticStudio::Work SyntheticStudio::chooseWork(std::unique_lock<std::mutex>& lock) {
    for (;;) {
        if (quit_) return Work::Quit;
        if (!requests_.empty()) return Work::Request;
        const bool video = videoWanted(), still = stillWanted();
        // With Pace::Consumer, a still is rendered before the next frame. With Pace::Realtime,
        // steps of a still and video frames alternate.
        const bool stillFirst = options_.pace == Pace::Consumer || stillsTurn_;
        stillsTurn_ = video && !(still && stillFirst);
        if (still && (stillFirst || !video)) return Work::Still;
        if (video) return Work::Video;
        if (options_.pace == Pace::Realtime && videoOn_ && !videoAllMade())
            changed_.wait_for(
                lock, std::max(videoTime(nextIndex_) - now(), std::chrono::nanoseconds(100us)));
        else
            changed_.wait(lock);
    }
}

bool SyntheticStudio::videoWanted() const {
    if (!videoOn_ || videoAllMade()) return false;
    if (options_.pace == Pace::Consumer) return video_.size() < kVideoAhead;
    return now() >= videoTime(nextIndex_);
}

bool SyntheticStudio::stillWanted() const {
    return std::ranges::any_of(stills_, [](const Still& s) { return !s.frame; });
}

void SyntheticStudio::makeVideo(Views& views) {
    const bool realtime = options_.pace == Pace::Realtime;
    const auto slot = videoPool_.acquire(realtime ? 0ms : 20ms);
    Timestamp time;
    {
        const std::lock_guard lock(mutex_);
        if (realtime) {
            const double late = std::chrono::duration<double>(now() - start_).count();
            nextIndex_ = std::max(nextIndex_, std::llround(std::floor(late * options_.rateHz)));
        }
        time = videoTime(nextIndex_);
        starved_ = !slot;
        if (slot || realtime) ++nextIndex_;
        if (!slot) changed_.notify_all();
    }
    if (!slot) return;
    views.video.begin(pose(time).T_world_video, worldTime(time),
                      synthetic::hash(options_.seed, time.ns - epoch_.ns, kVideoNoise));
    while (!views.video.step()) {
    }
    views.video.read(slot->data);
    Frame frame = videoPool_.lend(*slot, time);
    const std::lock_guard lock(mutex_);
    if (!videoOn_) return;
    ++videoMade_;
    if (realtime && video_.size() >= kVideoAhead) video_.pop_front();
    video_.push_back(std::move(frame));
    changed_.notify_all();
}

void SyntheticStudio::stepStill(Views& views) {
    Timestamp time;
    {
        const std::lock_guard lock(mutex_);
        const auto next = std::ranges::find_if(stills_, [](const Still& s) { return !s.frame; });
        if (next == stills_.end()) return;
        time = next->time;
    }
    if (rendering_ != time) {
        views.still.begin(pose(time).T_world_video * rig_.T_still_video.inverse(), worldTime(time),
                          synthetic::hash(options_.seed, time.ns - epoch_.ns, kStillNoise));
        rendering_ = time;
    }
    if (!views.still.complete() && !views.still.step()) return;
    const auto slot = stillPool_.acquire(options_.pace == Pace::Realtime ? 2ms : 20ms);
    if (slot) views.still.read(slot->data);
    const std::lock_guard lock(mutex_);
    starved_ = !slot;
    changed_.notify_all();
    if (!slot) return;
    rendering_.reset();
    Frame frame = stillPool_.lend(*slot, time);
    frame.exposure = options_.stillExposure;
    // If the camera was stopped in the meantime, stills_ does not contain this still, and the
    // rendered picture is discarded.
    const auto at =
        std::ranges::find_if(stills_, [&](const Still& s) { return s.time == time && !s.frame; });
    if (at != stills_.end()) at->frame = std::move(frame);
}

}  // namespace mfar
