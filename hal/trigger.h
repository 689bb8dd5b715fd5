#pragma once

#include "base/time.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace mfar {

/// The trigger cannot fire because its last pulse is still active; it can a moment later.
class TriggerBusy : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The line that triggers one exposure of the still sensor.
class Trigger {
public:
    virtual ~Trigger() = default;

    /// Fires one pulse and returns the time of its leading edge. Never waits for the still, which
    /// the still camera delivers later. Throws TriggerBusy during a pulse, std::runtime_error when
    /// the line cannot be driven.
    virtual Timestamp fire() = 0;
    /// Requests the line at its inactive level if it is not held yet; called repeatedly while the
    /// camera runs. Never throws.
    virtual void rest() {}
    /// Ends an active pulse at once: the line is inactive when this returns. Does nothing without a
    /// line. Callable from any thread. Never throws; the next fire() reports a line that cannot be
    /// driven.
    virtual void endPulse() {}
    [[nodiscard]] virtual std::string name() const = 0;
    /// Pulses for which not both edges were seen on the line: time and length of the exposure are
    /// not verified. Any thread.
    [[nodiscard]] virtual std::uint64_t missedEdges() const { return 0; }
};

}  // namespace mfar
