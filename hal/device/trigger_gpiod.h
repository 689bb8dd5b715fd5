#pragma once

#include "hal/device/pulse_trigger.h"

#include <chrono>
#include <memory>
#include <string>

namespace mfar {

struct TriggerOptions {
    std::string chip;  ///< label, name or path of the GPIO chip; empty: found by the line's name
    std::string line;  ///< number or name
    bool activeLow = false;
    std::chrono::microseconds pulse{1000};  ///< 1 us to 10 s
    std::string loopbackChip;               ///< empty: `chip`
    std::string loopback;  ///< input wired to `line`, number or name; empty: no loopback
};

/// Requests the line, at its inactive level, and the loopback. Throws std::runtime_error that lists
/// what is available, or names the line's user or the missing group.
[[nodiscard]] std::unique_ptr<PulseTrigger> openGpioTrigger(const TriggerOptions& options);

}  // namespace mfar
