#include "hal/device/request_cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace mfar {

RequestCycle::RequestCycle(RequestDriver& driver, const RestartLimits& limits, Clock clock)
    : driver_(driver), limits_(limits), clock_(std::move(clock)) {}

void RequestCycle::add() {
    const std::lock_guard lock(mutex_);
    requests_.push_back(State::Idle);
}

void RequestCycle::start() {
    const std::lock_guard life(lifecycle_);
    begin();
}

void RequestCycle::stop() {
    const std::lock_guard life(lifecycle_);
    halt();
}

void RequestCycle::close() {
    const std::lock_guard lock(mutex_);
    requests_.clear();
}

/// Only the thread that runs next() may call this function. The driver's thread must not wait here,
/// because it serves other cameras as well.
void RequestCycle::restart() {
    const std::lock_guard life(lifecycle_);
    {
        const std::lock_guard lock(mutex_);
        if (!running_) return;
        ++restarts_;
    }
    halt();
    begin();
}

/// The caller of begin() and halt() must have locked lifecycle_.
void RequestCycle::begin() {
    {
        const std::lock_guard lock(mutex_);
        if (running_) return;
        if (!lost_.empty()) throw DeviceLost(lost_);
    }
    driver_.start();
    const std::lock_guard lock(mutex_);
    running_ = true;
    restartAt_.reset();
    begun_ = clock_();
    queueIdle();
}

void RequestCycle::halt() {
    driver_.prepareStop();
    {
        const std::lock_guard lock(mutex_);
        if (!running_) return;
        running_ = false;
    }
    changed_.notify_all();
    // driver_.stop() completes the queued requests, and their callbacks lock mutex_. So mutex_ must
    // not be locked here.
    driver_.stop();
    const std::lock_guard lock(mutex_);
    ready_.clear();
    for (State& state : requests_)
        if (state != State::Lent) state = State::Idle;
}

bool RequestCycle::anyQueued() const {
    return std::ranges::find(requests_, State::Queued) != requests_.end();
}

/// The caller of queue(), queueIdle() and planRestart() must have locked mutex_.
void RequestCycle::queue(std::size_t request) {
    requests_[request] = State::Queued;
    const int error = driver_.queue(request);
    if (error == 0) return;
    requests_[request] = State::Idle;
    loseLocked(fmt::format("{} accepts no more requests (error {})", name_, -error));
}

void RequestCycle::queueIdle() {
    for (std::size_t i = 0; i < requests_.size() && lost_.empty(); ++i)
        if (requests_[i] == State::Idle) queue(i);
}

void RequestCycle::loseLocked(const std::string& why) {
    if (lost_.empty()) lost_ = why;
    changed_.notify_all();
}

void RequestCycle::lose(const std::string& why) {
    const std::lock_guard lock(mutex_);
    loseLocked(why);
}

void RequestCycle::giveBack(std::size_t request) {
    const std::lock_guard lock(mutex_);
    if (request >= requests_.size()) return;
    requests_[request] = State::Idle;
    if (running_ && lost_.empty()) queue(request);
}

void RequestCycle::completed(std::size_t request, const Judge& judge) {
    const std::lock_guard lock(mutex_);
    if (request >= requests_.size()) return;
    requests_[request] = State::Idle;
    changed_.notify_all();
    if (!running_) return;
    if (const std::optional<Done> done = judge()) {
        requests_[request] = State::Ready;
        ready_.push_back(*done);
        ++delivered_;
    }
    queueIdle();
}

void RequestCycle::cancelled(std::size_t request) {
    const std::lock_guard lock(mutex_);
    if (request >= requests_.size()) return;
    requests_[request] = State::Idle;
    changed_.notify_all();
    if (running_ && !anyQueued()) planRestart();
}

/// Sets the time of the next restart, unless an earlier cancelled request has already set it.
void RequestCycle::planRestart() {
    if (restartAt_) return;
    const Timestamp now = clock_();
    earlyEnds_ = now - begun_ < limits_.early ? earlyEnds_ + 1 : 0;
    if (earlyEnds_ >= limits_.most)
        return loseLocked(fmt::format(
            "{} stopped by itself {} times in a row, each time within {} ms of its start", name_,
            earlyEnds_, limits_.early.count()));
    restartAt_ = now;
    if (earlyEnds_ > 1) restartAt_ = now + limits_.firstPause * (1 << (earlyEnds_ - 2));
}

std::optional<RequestCycle::Done> RequestCycle::next(std::chrono::milliseconds timeout) {
    const Timestamp end = clock_() + timeout;
    std::unique_lock lock(mutex_);
    while (running_ && lost_.empty() && ready_.empty()) {
        const Timestamp now = clock_();
        if (restartAt_ && now >= *restartAt_) {
            lock.unlock();
            restart();
            return std::nullopt;
        }
        if (now >= end) return std::nullopt;
        changed_.wait_for(lock, (restartAt_ ? std::min(end, *restartAt_) : end) - now);
    }
    if (!lost_.empty()) throw DeviceLost(lost_);
    if (!running_) return std::nullopt;
    const Done done = ready_.front();
    ready_.pop_front();
    requests_[done.request] = State::Lent;
    return done;
}

bool RequestCycle::awaitSign(std::chrono::milliseconds within) {
    std::unique_lock lock(mutex_);
    const std::uint64_t before = delivered_;
    return changed_.wait_for(lock, within,
                             [&] { return !running_ || delivered_ != before || !anyQueued(); });
}

std::uint64_t RequestCycle::delivered() const {
    const std::lock_guard lock(mutex_);
    return delivered_;
}

std::uint64_t RequestCycle::restarts() const {
    const std::lock_guard lock(mutex_);
    return restarts_;
}

}  // namespace mfar
