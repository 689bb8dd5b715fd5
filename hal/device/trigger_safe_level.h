#pragma once

#include "hal/device/trigger_gpiod.h"

namespace mfar {

/// Drives the trigger line to its inactive level and releases it. After mfard has ended, systemd
/// runs the program release-trigger, which calls this function: mfard may have crashed during a
/// pulse. Throws std::runtime_error.
void driveSafe(const TriggerOptions& options);

}  // namespace mfar
