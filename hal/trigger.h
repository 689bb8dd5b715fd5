#pragma once

#include "base/time.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace mfar {

/// The trigger cannot fire now because its last pulse is still on; a moment later it can.
class TriggerBusy : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The line that makes the still sensor expose one picture.
class Trigger {
public:
    virtual ~Trigger() = default;

    /// Fires one pulse and returns the time of its leading edge. Never waits for the still; the
    /// picture arrives later through the still camera. Throws std::runtime_error when the line
    /// cannot be driven, TriggerBusy when it can later.
    virtual Timestamp fire() = 0;
    /// Takes the line, at its level at rest, where that has not been done or could not be; called
    /// again and again while the camera runs. Never throws.
    virtual void rest() {}
    /// Ends a pulse that is on at once: the line is inactive when this returns. May be called from
    /// any thread, and where no line is driven it does nothing. Never throws; a line that cannot be
    /// driven is reported by the next fire().
    virtual void endPulse() {}
    [[nodiscard]] virtual std::string name() const = 0;
    /// Pulses whose edges were looked for on the line and not both seen: when and how long the
    /// sensor exposed is not verified. Any thread.
    [[nodiscard]] virtual std::uint64_t missedEdges() const { return 0; }
};

}  // namespace mfar
