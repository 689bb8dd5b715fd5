#pragma once

#include "hal/device/trigger_gpiod.h"

namespace mfar {

/// Drives the trigger line to its inactive level and releases it. The service calls this function
/// after mfard has ended, because mfard may have crashed during a pulse. Throws std::runtime_error.
void driveSafe(const TriggerOptions& options);

}  // namespace mfar
