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

/// A pulse as measured by the loopback line.
struct MeasuredPulse {
    Timestamp start;  ///< leading edge
    Timestamp end;    ///< trailing edge; end - start is the exposure if the pulse length sets it
};

/// Pulses on one line. The line is inactive from the constructor to the destructor, except during
/// a pulse. Thread-safe.
///
/// The caller of fire() drives a pulse of up to 1 ms completely; a longer one is ended by a thread
/// of this object, which sleeps until 0.1 ms before its end and then polls the clock, because many
/// sensors expose for the pulse's length.
class PulseTrigger final : public Trigger {
public:
    /// `loopback` may be null. Throws std::runtime_error unless the pulse is 1 us to 10 s.
    PulseTrigger(std::string name, std::unique_ptr<OutputLine> line,
                 std::unique_ptr<EdgeInput> loopback, std::chrono::microseconds pulse);
    PulseTrigger(const PulseTrigger&) = delete;
    PulseTrigger& operator=(const PulseTrigger&) = delete;
    /// Ends a running pulse at once.
    ~PulseTrigger() override;

    /// Returns the time of the leading edge: from the loopback if it reported one, otherwise the
    /// mean of the clock before and after driving the line. Throws TriggerBusy during a pulse: a
    /// second pulse is refused, not queued, because its edge would come at an unwanted time. Throws
    /// std::runtime_error when the line cannot be driven or an earlier pulse could not be ended.
    Timestamp fire() override;
    void endPulse() override;
    [[nodiscard]] std::string name() const override { return name_; }

    /// The last pulse whose edges were both reported by the loopback.
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
    bool running_ = false;              ///< a pulse is active
    Timestamp begun_;                   ///< time just before the leading edge was driven
    Timestamp due_;                     ///< end of the pulse
    std::optional<Timestamp> leading_;  ///< leading edge, as the loopback reported it
    /// A pulse could not be ended; reported by the next fire().
    std::optional<std::string> failure_;
    std::optional<MeasuredPulse> measured_;
    std::uint64_t missed_ = 0;
    std::jthread ender_;  ///< last member: joins before the others are destroyed
};

}  // namespace mfar
