#pragma once

#include "base/time.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace mfar {

/// Thrown if the trigger cannot fire now, because its last pulse has not ended or the still camera
/// is stopped.
class TriggerBusy : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Each pulse of the trigger starts one exposure of the still sensor.
class Trigger {
public:
    virtual ~Trigger() = default;

    /// Fires one pulse and returns the time of its leading edge. Does not wait for the still.
    /// Throws TriggerBusy during a pulse, and std::runtime_error if the line cannot be driven.
    virtual Timestamp fire() = 0;
    /// Requests the trigger line at its inactive level, unless this object already holds the line.
    /// Never throws.
    virtual void rest() {}
    /// Ends an active pulse at once. Thread-safe. Never throws: if the line cannot be driven, the
    /// next fire() throws.
    virtual void endPulse() {}
    /// Returns true if the still of a pulse is certain to arrive, however late, because it is being
    /// simulated. Thread-safe.
    [[nodiscard]] virtual bool isStillComing() const { return false; }
    [[nodiscard]] virtual std::string name() const = 0;
    /// Returns the number of pulses whose times are not measured, because the loopback line (an
    /// input that is wired to the trigger line) did not report both edges. Thread-safe.
    [[nodiscard]] virtual std::uint64_t missedEdges() const { return 0; }
};

}  // namespace mfar
