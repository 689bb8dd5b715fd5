#pragma once

#include "hal/device/gpio_lines.h"
#include "hal/trigger.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace mfar {

/// Times of a pulse's leading and trailing edge. The loopback line, an input that is wired to the
/// trigger line, measured them.
struct MeasuredPulse {
    Timestamp start;
    Timestamp end;
};

/// Drives pulses on one GPIO line. The line is inactive from the constructor to the destructor,
/// except during a pulse. Thread-safe.
///
/// The length of a pulse must be accurate, because many sensors expose as long as the pulse lasts.
/// fire() itself waits for the end of a pulse of at most 1 ms. A thread ends longer pulses: it
/// sleeps until 0.1 ms before the end and then polls the clock.
class PulseTrigger final : public Trigger {
public:
    /// `loopback` may be null. Throws std::runtime_error unless `pulse` is from 1 us to 10 s.
    PulseTrigger(std::string name, std::unique_ptr<OutputLine> line,
                 std::unique_ptr<EdgeInput> loopback, std::chrono::microseconds pulse);
    PulseTrigger(const PulseTrigger&) = delete;
    PulseTrigger& operator=(const PulseTrigger&) = delete;
    ~PulseTrigger() override;

    /// Starts a pulse and returns the time of its leading edge as the loopback line measured it.
    /// Without a report of the loopback line, returns the mean of the times before and after the
    /// line was driven. Throws TriggerBusy if a pulse is active. Throws std::runtime_error if the
    /// line cannot be driven, or if an earlier pulse could not be ended. If the loopback line
    /// cannot be read, the pulse counts in missedEdges().
    Timestamp fire() override;
    void endPulse() override;
    [[nodiscard]] std::string name() const override { return name_; }

    [[nodiscard]] std::optional<MeasuredPulse> measured() const;
    [[nodiscard]] std::uint64_t missedEdges() const override;

private:
    void endLater(const std::stop_token& stop);
    void end();
    [[nodiscard]] std::optional<Timestamp> nextEdge(std::chrono::microseconds timeout);
    [[nodiscard]] std::optional<Timestamp> edgeSince(Timestamp earliest);
    void measure(Timestamp endDriven);

    std::string name_;
    std::unique_ptr<OutputLine> line_;
    std::unique_ptr<EdgeInput> loopback_;
    std::chrono::microseconds pulse_;

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    bool running_ = false;
    Timestamp begun_;
    Timestamp due_;
    std::optional<Timestamp> leading_;
    /// Reason why a pulse could not be ended. The next fire() throws it.
    std::optional<std::string> failure_;
    std::optional<MeasuredPulse> measured_;
    std::uint64_t missed_ = 0;
    std::jthread ender_;  ///< must be the last member, because the thread uses the members above
};

}  // namespace mfar
