#pragma once

#include "hal/device/pulse_trigger.h"

#include <chrono>
#include <memory>
#include <string>

namespace mfar {

struct TriggerOptions {
    std::string chip;  ///< label, name or path of the GPIO chip; empty: any chip with the line
    std::string line;
    bool activeLow = false;
    std::chrono::microseconds pulse{1000};
    std::string loopbackChip;
    /// Number or name of the loopback line, an input that is wired to `line` and reports its edges.
    /// Empty: there is none.
    std::string loopback;
};

/// Requests the trigger line at its inactive level. Also requests the loopback line, if there is
/// one. Throws std::runtime_error. If a chip or line is not found, the message lists the available
/// ones. If a line is in use, the message names the program that uses it, if that is known. If
/// permission is missing, the message names the group that the user must join.
[[nodiscard]] std::unique_ptr<PulseTrigger> openGpioTrigger(const TriggerOptions& options);

}  // namespace mfar
