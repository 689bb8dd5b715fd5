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

/// A pulse as the loopback line saw it.
struct MeasuredPulse {
    Timestamp start;  ///< leading edge
    Timestamp end;    ///< trailing edge; end - start is the exposure where the pulse makes it
};

/// Pulses on one line. The line is inactive from the constructor to the destructor, except during
/// a pulse. Thread-safe.
///
/// A pulse of up to 1 ms is driven whole by the caller of fire(); a longer one is ended by a thread
/// of this object, which sleeps until 0.1 ms before and then watches the clock, because the length
/// is the exposure of many sensors.
class PulseTrigger final : public Trigger {
public:
    /// `loopback` may be null. Throws std::runtime_error when the pulse is not in 1 us to 10 s.
    PulseTrigger(std::string name, std::unique_ptr<OutputLine> line,
                 std::unique_ptr<EdgeInput> loopback, std::chrono::microseconds pulse);
    PulseTrigger(const PulseTrigger&) = delete;
    PulseTrigger& operator=(const PulseTrigger&) = delete;
    /// Ends a running pulse at once.
    ~PulseTrigger() override;

    /// The leading edge: from the loopback when it has seen one, otherwise the middle between the
    /// clock before and after driving the line. Throws TriggerBusy during a pulse: a second pulse
    /// is refused, not queued, because its edge would come at a time nobody asked for. Throws
    /// std::runtime_error when the line cannot be driven or an earlier pulse could not be ended.
    Timestamp fire() override;
    void endPulse() override;
    [[nodiscard]] std::string name() const override { return name_; }

    /// The last pulse whose both edges the loopback has seen.
    [[nodiscard]] std::optional<MeasuredPulse> measured() const;
    /// Pulses of which the loopback missed an edge.
    [[nodiscard]] std::uint64_t missedEdges() const override;

private:
    void endLater(const std::stop_token& stop);
    void end();
    [[nodiscard]] std::optional<Timestamp> edgeSince(Timestamp earliest);
    void measure(Timestamp endDriven);

    std::string name_;
    std::unique_ptr<OutputLine> line_;
    std::unique_ptr<EdgeInput> loopback_;
    std::chrono::microseconds pulse_;

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    bool running_ = false;                ///< a pulse is on
    Timestamp begun_;                     ///< just before its leading edge was driven
    Timestamp due_;                       ///< when it ends
    std::optional<Timestamp> leading_;    ///< as the loopback saw it
    std::optional<std::string> failure_;  ///< of ending a pulse; told by the next fire()
    std::optional<MeasuredPulse> measured_;
    std::uint64_t missed_ = 0;
    std::jthread ender_;  ///< last: ends before the rest
};

}  // namespace mfar
