#include "hal/device/pulse_trigger.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace mfar {
namespace {

using std::chrono::microseconds;

constexpr microseconds kLongest{10'000'000};
/// Longest pulse whose end fire() itself waits for. Another thread would end the pulse less
/// accurately.
constexpr microseconds kInCaller{1000};
/// Longest delay with which a sleeping thread wakes up, unless the machine is overloaded.
constexpr microseconds kWakeUp{100};
/// Longest wait for the kernel to report an edge. The kernel does so within microseconds or never.
constexpr microseconds kEdgeWait{1000};

std::chrono::steady_clock::time_point steady(Timestamp time) {
    return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(time.ns));
}

void sleepUntil(Timestamp time) {
    std::this_thread::sleep_until(steady(time - kWakeUp));
    while (Timestamp::now() < time) {
    }
}

}  // namespace

PulseTrigger::PulseTrigger(std::string name, std::unique_ptr<OutputLine> line,
                           std::unique_ptr<EdgeInput> loopback, microseconds pulse)
    : name_(std::move(name)), line_(std::move(line)), loopback_(std::move(loopback)),
      pulse_(pulse) {
    line_->set(false);
    if (pulse < microseconds{1} || pulse > kLongest)
        throw std::runtime_error(
            fmt::format("a trigger pulse must be from 1 us to 10 s, not {} us", pulse.count()));
    ender_ = std::jthread([this](const std::stop_token& stop) { endLater(stop); });
}

PulseTrigger::~PulseTrigger() {
    ender_.request_stop();
    ender_.join();
    try {
        line_->set(false);
    } catch (const std::runtime_error&) {
        // The GPIO chip is lost. Nothing is thrown, because this is a destructor.
    }
}

Timestamp PulseTrigger::fire() {
    std::lock_guard lock(mutex_);
    if (failure_) throw std::runtime_error(*std::exchange(failure_, std::nullopt));
    if (running_) throw TriggerBusy(name_ + ": the previous pulse has not ended yet");
    while (nextEdge(microseconds{0})) {
    }
    leading_.reset();
    begun_ = Timestamp::now();
    line_->set(true);
    const Timestamp driven = begun_ + (Timestamp::now() - begun_) / 2;
    due_ = driven + pulse_;
    if (pulse_ <= kInCaller) {
        sleepUntil(due_);
        end();
        if (failure_) throw std::runtime_error(*std::exchange(failure_, std::nullopt));
    } else {
        running_ = true;
        wake_.notify_one();
        leading_ = edgeSince(begun_);
    }
    return leading_.value_or(driven);
}

void PulseTrigger::endPulse() {
    const std::lock_guard lock(mutex_);
    if (!running_) return;
    running_ = false;
    end();
    wake_.notify_one();
}

void PulseTrigger::endLater(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wake_.wait(lock, stop, [this] { return running_; })) {
        const Timestamp due = due_;
        const auto isOver = [&] { return !running_ || due_ != due; };
        if (wake_.wait_until(lock, stop, steady(due - kWakeUp), isOver)) continue;
        if (!stop.stop_requested()) sleepUntil(due);
        running_ = false;
        end();
    }
}

void PulseTrigger::end() {
    const Timestamp endDriven = Timestamp::now();
    try {
        line_->set(false);
    } catch (const std::runtime_error& error) {
        failure_ = error.what();
        return;
    }
    if (loopback_) measure(endDriven);
}

/// Returns nothing if the loopback line cannot be read, e.g. because its chip is unplugged. The
/// trigger line works without it, and a pulse that was driven must not be lost.
std::optional<Timestamp> PulseTrigger::nextEdge(microseconds timeout) {
    if (!loopback_) return std::nullopt;
    try {
        return loopback_->next(timeout);
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

std::optional<Timestamp> PulseTrigger::edgeSince(Timestamp earliest) {
    while (const std::optional<Timestamp> edge = nextEdge(kEdgeWait)) {
        // Before version 5.7, the kernel takes the times of edges from another clock than
        // CLOCK_MONOTONIC. Such times lie in the future and are ignored.
        if (*edge > Timestamp::now()) return std::nullopt;
        if (*edge >= earliest) return edge;
    }
    return std::nullopt;
}

/// Distinguishes the two edges of a pulse by their times. Their reported types (rising, falling)
/// may be wrong, because the kernel reads the level when a short pulse is already over.
void PulseTrigger::measure(Timestamp endDriven) {
    if (!leading_) leading_ = edgeSince(begun_);
    if (leading_ && *leading_ >= endDriven) leading_.reset();
    const std::optional<Timestamp> trailing =
        leading_ ? edgeSince(endDriven) : std::optional<Timestamp>{};
    if (trailing)
        measured_ = MeasuredPulse{*leading_, *trailing};
    else
        ++missed_;
}

std::optional<MeasuredPulse> PulseTrigger::measured() const {
    std::lock_guard lock(mutex_);
    return measured_;
}

std::uint64_t PulseTrigger::missedEdges() const {
    std::lock_guard lock(mutex_);
    return missed_;
}

}  // namespace mfar
